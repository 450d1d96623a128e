! SPDX-License-Identifier: BSD-3-Clause
!> All that is made from the equations of a model, against its right-hand side: by differences, and
!> by inserting the Taylor series. In quadruple precision differences of step 1e-8 are good to 15
!> digits.
module model_consistency
   use characteristic_function, only: characteristic_of, characteristic_type
   use dde_errors, only: text
   use dde_kinds, only: wp
   use expectations, only: expect_close
   use mctc_env_testing, only: error_type
   use model_problem, only: model_type
   use pseudo_random, only: uniform
   implicit none (type, external)
   private
   public :: check_forms, check_model, check_rest

   !> Step of differences, and what they are good for.
   real(wp), parameter :: h = 1.0e-8_wp, good = 1.0e-13_wp
   !> Degree of series, time, and where the series are inserted.
   integer, parameter :: degree = 12
   real(wp), parameter :: now = 0.3_wp, place = 1.0e-3_wp
   !> Disturbances: more than are computed at a time.
   integer, parameter :: vectors = 6

contains

   !> Right-hand side, Jacobian and, with constant delays, series at a state and delayed values.
   subroutine check_model(error, model, y, z, name)
      type(error_type), allocatable, intent(inout) :: error
      class(model_type), intent(in) :: model
      real(wp), intent(in) :: y(:), z(:)
      character(len=*), intent(in) :: name

      if (allocated(error)) return
      call check_jacobian(error, model, y, z, name)
      if (model%moving > 0) return
      call check_series(error, model, y, z, name)
      call check_tangents(error, model, y, z, name, slow=.false.)
      if (model%relaxation_rate(now, y) > 0.0_wp) then
         call check_tangents(error, model, y, z, name, slow=.true.)
      end if
   end subroutine check_model

   !> Derivatives by states and delayed values.
   subroutine check_jacobian(error, model, y, z, name)
      type(error_type), allocatable, intent(inout) :: error
      class(model_type), intent(in) :: model
      real(wp), intent(in) :: y(:), z(:)
      character(len=*), intent(in) :: name
      real(wp) :: after(size(y)), before(size(y)), by_y(size(y), size(y)), &
                  by_z(size(y), size(z)), columns(size(y), size(y) + size(z)), &
                  shift(size(y) + size(z))
      integer :: i

      call find_slopes(model, y, z, by_y, by_z)
      columns = reshape([by_y, by_z], shape(columns))
      associate (n => size(y))
         do i = 1, size(shift)
            shift = 0.0_wp
            shift(i) = h
            call model%rhs(now, y + shift(:n), z + shift(n + 1:), after)
            call model%rhs(now, y - shift(:n), z - shift(n + 1:), before)
            call compare(error, columns(:, i), (after - before)/(2.0_wp*h), good, &
                         name//", slope by state or delayed value "//text(i))
         end do
      end associate
   end subroutine check_jacobian

   !> Derivatives as full matrices.
   subroutine find_slopes(model, y, z, by_y, by_z)
      class(model_type), intent(in) :: model
      real(wp), intent(in) :: y(:), z(:)
      real(wp), intent(out) :: by_y(:, :), by_z(:, :)
      real(wp), allocatable :: band(:, :), rows(:, :)
      integer :: j

      if (model%lower < 0) then
         call model%jacobian(now, y, z, by_y, by_z)
         return
      end if
      allocate (band(1 + model%lower + model%upper, size(y)), &
                rows(size(y)/model%shape%blocks, size(z)))
      call model%jacobian(now, y, z, band, rows)
      by_y = 0.0_wp
      do j = 1, size(y)
         associate (first => max(1, j - model%upper), last => min(size(y), j + model%lower))
            by_y(first:last, j) = band(1 + model%upper + first - j:1 + model%upper + last - j, j)
         end associate
      end do
      by_z = 0.0_wp
      do j = 1, size(z)
         by_z(model%rows(1, j):model%rows(2, j), j) = rows(:, j)
      end do
   end subroutine find_slopes

   !> The series solve the equations: y'(s) = unit f(y(s), z(s)) up to the powers left out.
   subroutine check_series(error, model, y, z, name)
      type(error_type), allocatable, intent(inout) :: error
      class(model_type), intent(in) :: model
      real(wp), intent(in) :: y(:), z(:)
      character(len=*), intent(in) :: name
      integer :: k
      real(wp), parameter :: powers(0:degree) = [(place**k, k=0, degree)], &
                             slopes(0:degree) = [0.0_wp, (k*place**(k - 1), k=1, degree)]
      real(wp) :: unit
      real(wp) :: expected(size(y)), of_y(0:degree, size(y)), of_z(0:degree, size(z))

      unit = unit_for(model, y, z)
      of_y = 0.0_wp
      of_y(0, :) = y
      of_z = delayed_series(z)
      call model%series(now, unit, degree, of_z, of_y)
      call model%rhs(now + place*unit, matmul(powers, of_y), matmul(powers, of_z), expected)
      ! the first power left out is as large as the last one kept, and s is small
      associate (left_out => 100.0_wp*degree*maxval(abs(of_y(degree, :)))*place**degree)
         call compare(error, matmul(slopes, of_y), unit*expected, 1.0e-28_wp + left_out, &
                      name//", slope of the series")
      end associate
   end subroutine check_series

   !> Series of disturbances, by differences of series. Those of the slow solution, too: on it w is
   !> its balance less w'/rate, and an iteration gives the series back, but for the last powers, of
   !> which w' is not known. Of disturbances it gives those of neighbouring iterations.
   subroutine check_tangents(error, model, y, z, name, slow)
      type(error_type), allocatable, intent(inout) :: error
      class(model_type), intent(in) :: model
      real(wp), intent(in) :: y(:), z(:)
      character(len=*), intent(in) :: name
      logical, intent(in) :: slow
      real(wp), dimension(0:degree, size(y)) :: better, of_y
      real(wp) :: unit
      real(wp) :: of_z(0:degree, size(z)), dz(0:degree, size(z), vectors), &
                  dy(0:degree, size(y), vectors)
      integer :: i

      unit = unit_for(model, y, z)
      of_z = delayed_series(z)
      of_y(0, :) = y
      call model%series(now, unit, degree, of_z, of_y)
      dy = 0.0_wp
      do i = 1, vectors
         dy(0, :, i) = uniform(500 + i, size(y), -1.0_wp, 1.0_wp)
         dz(:, :, i) = reshape(uniform(600 + i, size(of_z), -1.0_wp, 1.0_wp), shape(of_z))
      end do
      call model%tangent_series(now, unit, degree, of_z, of_y, vectors, dz, dy)
      if (slow) then
         better = of_y
         call model%slow_series(now, unit, degree, of_z, better)
         call compare(error, [better(:degree - 1, :)], [of_y(:degree - 1, :)], 1.0e-28_wp, &
                      name//", slow series")
         call model%slow_tangent_series(now, unit, degree, of_z, of_y, better, vectors, dz, dy)
      end if
      do i = 1, vectors
         call compare(error, [dy(:, :, i)], [(moved(i, h) - moved(i, -h))/(2.0_wp*h)], good, &
                      name//", "//merge("slow ", "     ", slow)//"series of disturbance "//text(i))
      end do

   contains

      !> The series with a part of a disturbance.
      function moved(number, part) result(series)
         integer, intent(in) :: number
         real(wp), intent(in) :: part
         real(wp) :: series(0:degree, size(y))

         series(0, :) = y + part*uniform(500 + number, size(y), -1.0_wp, 1.0_wp)
         call model%series(now, unit, degree, of_z + part*dz(:, :, number), series)
         if (slow) call model%slow_series(now, unit, degree, of_z + part*dz(:, :, number), series)
      end function moved
   end subroutine check_tangents

   !> Derivative forms at the steady state: the first is the Jacobian, others are differences of it.
   subroutine check_forms(error, model, name)
      type(error_type), allocatable, intent(inout) :: error
      class(model_type), intent(in) :: model
      character(len=*), intent(in) :: name
      real(wp), parameter :: wide = 1.0e-6_wp
      real(wp) :: mixed(model%n, 2), x(model%n, 1 + size(model%lag), 3)
      integer :: i

      if (allocated(error)) return
      do i = 1, 3
         x(:, :, i) = reshape(uniform(700 + i, size(x(:, :, 1)), -1.0_wp, 1.0_wp), &
                              shape(x(:, :, 1)))
      end do
      call check(1, slope_at(0.0_wp*x(:, :, 1), x(:, :, 1)), good)
      call check(2, (slope_at(h*x(:, :, 2), x(:, :, 1)) &
                     - slope_at(-h*x(:, :, 2), x(:, :, 1)))/(2.0_wp*h), good)
      do i = 1, 2
         associate (way => (-1)**i*wide*x(:, :, 3))
            mixed(:, i) = (slope_at(way + wide*x(:, :, 2), x(:, :, 1)) &
                           - slope_at(way - wide*x(:, :, 2), x(:, :, 1)))/(2.0_wp*wide)
         end associate
      end do
      call check(3, (mixed(:, 2) - mixed(:, 1))/(2.0_wp*wide), 1.0e-9_wp)

   contains

      !> The form of an order.
      subroutine check(order, expected, within)
         integer, intent(in) :: order
         real(wp), intent(in) :: expected(:), within

         call compare(error, real(model%derivative(cmplx(x(:, :, :order), kind=wp))), expected, &
                      within, name//", form of order "//text(order))
      end subroutine check

      !> The Jacobian at a shift from the steady state, times a disturbance.
      function slope_at(shift, disturbance) result(slope)
         real(wp), intent(in) :: shift(:, :), disturbance(:, :)
         real(wp) :: slope(model%n)
         real(wp) :: by_y(model%n, model%n), by_z(model%n, size(model%lag))
         integer :: k

         associate (state => model%steady_state())
            call model%jacobian(now, state + shift(:, 1), &
                                [(state(model%component(k)) + shift(model%component(k), k + 1), &
                                  k=1, size(model%lag))], by_y, by_z)
         end associate
         slope = matmul(by_y, disturbance(:, 1))
         do k = 1, size(model%lag)
            slope = slope + by_z(:, k)*disturbance(model%component(k), k + 1)
         end do
      end function slope_at
   end subroutine check_forms

   !> The equations vanish at the steady state, and the characteristic function is the determinant
   !> of the characteristic matrix there; its derivatives by the parameters. A chain has one block.
   subroutine check_rest(error, model, name)
      type(error_type), allocatable, intent(inout) :: error
      class(model_type), intent(in) :: model
      character(len=*), intent(in) :: name
      complex(wp), parameter :: s = (0.3_wp, 0.7_wp)
      real(wp) :: by_y(model%n, model%n), by_z(model%n, size(model%lag)), dydt(model%n), &
                  lag(size(model%lag))
      complex(wp) :: matrix(model%n, model%n)
      type(characteristic_type) :: c
      integer :: i, k

      if (allocated(error)) return
      lag = model%lag
      associate (state => model%steady_state())
         associate (moving => model%moving)
            if (moving > 0) call model%moving_lags(now, state, lag(size(lag) - moving + 1:))
         end associate
         call model%rhs(now, state, state(model%component), dydt)
         call compare(error, dydt, 0.0_wp*dydt, 1.0e-30_wp, name//", rates at rest")
         call find_slopes(model, state, state(model%component), by_y, by_z)
      end associate
      matrix = -by_y
      do i = 1, model%n
         matrix(i, i) = matrix(i, i) + s
      end do
      do k = 1, size(model%lag)
         associate (column => matrix(:, model%component(k)))
            column = column - by_z(:, k)*exp(-s*lag(k))
         end associate
      end do
      c = characteristic_of(model)
      call compare_values(c%value(s), determinant(matrix), 1.0e-28_wp, "characteristic function")
      do i = 1, size(model%numbers)
         call compare_values(c%by_parameter(i, s), (value_at(i, h) - value_at(i, -h))/(2.0_wp*h), &
                             good, "slope by parameter "//text(i))
      end do

   contains

      !> The characteristic function at another value of a parameter.
      complex(wp) function value_at(parameter, shift) result(value)
         integer, intent(in) :: parameter
         real(wp), intent(in) :: shift
         type(model_type) :: moved
         type(characteristic_type) :: of_moved

         moved = model
         moved%numbers(parameter) = moved%numbers(parameter) + shift
         of_moved = characteristic_of(moved)
         value = of_moved%value(s)
      end function value_at

      subroutine compare_values(met, expected, tolerance, what)
         complex(wp), intent(in) :: met, expected
         real(wp), intent(in) :: tolerance
         character(len=*), intent(in) :: what

         call compare(error, [real(met), aimag(met)], [real(expected), aimag(expected)], &
                      tolerance, name//", "//what)
      end subroutine compare_values
   end subroutine check_rest

   !> The determinant of a matrix, by its first column.
   recursive function determinant(matrix) result(value)
      complex(wp), intent(in) :: matrix(:, :)
      complex(wp) :: value
      integer :: i, k

      value = 1.0_wp
      if (size(matrix, 1) == 0) return
      value = 0.0_wp
      do i = 1, size(matrix, 1)
         associate (others => pack([(k, k=1, size(matrix, 1))], [(k /= i, k=1, size(matrix, 1))]))
            value = value - (-1)**i*matrix(i, 1)*determinant(matrix(others, 2:))
         end associate
      end do
   end function determinant

   !> A unit of time in which the solution changes little.
   function unit_for(model, y, z) result(unit)
      class(model_type), intent(in) :: model
      real(wp), intent(in) :: y(:), z(:)
      real(wp) :: unit
      real(wp) :: by_y(size(y), size(y)), by_z(size(y), size(z)), dydt(size(y))

      call find_slopes(model, y, z, by_y, by_z)
      call model%rhs(now, y, z, dydt)
      unit = 1.0_wp/(1.0_wp + maxval(abs(by_y)) + maxval(abs(dydt)))
   end function unit_for

   !> Delayed values as series.
   function delayed_series(z) result(series)
      real(wp), intent(in) :: z(:)
      real(wp) :: series(0:degree, size(z))
      integer :: i

      do i = 1, size(z)
         series(:, i) = uniform(400 + i, degree + 1, -0.5_wp, 0.5_wp)
      end do
      series(0, :) = z
   end function delayed_series

   !> Numbers agree, relative to the largest.
   subroutine compare(error, met, expected, tolerance, what)
      type(error_type), allocatable, intent(inout) :: error
      real(wp), intent(in) :: met(:), expected(:), tolerance
      character(len=*), intent(in) :: what

      call expect_close(error, maxval(abs(met - expected))/max(1.0_wp, maxval(abs(expected))), &
                        0.0_wp, tolerance, what)
   end subroutine compare
end module model_consistency
