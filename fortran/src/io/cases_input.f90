!> Cases to measure, from the namelist group &cases_list: one list a key, one element a case.
module cases_input
   use block_parameters, only: block_history_type, block_parameters_type, check_quantity
   use dde_errors, only: error_type, raise, text
   use dde_kinds, only: wp
   use measured_case, only: case_name_length, case_type
   use namelist_input, only: close_namelist, not_given, open_namelist, word_length
   use value_checks, only: check_number
   implicit none (type, external)
   private
   public :: read_cases

   !> Most cases in one file.
   integer, parameter :: most_cases = 1000
   !> Most samples of a case.
   real(wp), parameter :: most_samples = 1.0e6_wp

contains

   !> Read and check the cases.
   subroutine read_cases(path, cases, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The cases
      type(case_type), allocatable, intent(out) :: cases(:)
      !> They cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      integer :: i

      call read_group(path, cases, error)
      if (allocated(error)) return
      if (size(cases) == 0) call raise(error, path//": name: no case; expected at least one")
      do i = 1, size(cases)
         call check_case(path//": case '"//trim(cases(i)%name)//"'", cases(i), error)
         if (allocated(error)) return
         if (any(cases(:i - 1)%name == cases(i)%name)) then
            call raise(error, path//": name = '"//trim(cases(i)%name) &
                       //"' twice; expected each once")
         end if
      end do
   end subroutine read_cases

   !> Read the group &cases_list.
   subroutine read_group(path, cases, error)
      !> Path of the namelist file
      character(len=*), intent(in) :: path
      !> The cases
      type(case_type), allocatable, intent(out) :: cases(:)
      !> They cannot be read
      type(error_type), allocatable, intent(out) :: error
      character(len=word_length) :: name(most_cases)
      real(wp), dimension(most_cases) :: tau, epsilon, xi, gamma, theta, u, v, t_end, &
                                         sample_interval
      character(len=256) :: reason
      integer :: i, status, unit
      namelist /cases_list/ name, tau, epsilon, xi, gamma, theta, u, v, t_end, sample_interval

      name = ""
      tau = not_given()
      epsilon = tau
      xi = tau
      gamma = tau
      theta = tau
      u = tau
      v = tau
      t_end = tau
      sample_interval = tau
      call open_namelist(path, "cases_list", unit, error)
      if (allocated(error)) return
      read (unit, nml=cases_list, iostat=status, iomsg=reason)
      call close_namelist(path, "cases_list", unit, status, reason, error)
      cases = [(case_type(name(i) (:case_name_length), &
                          block_parameters_type(tau=tau(i), epsilon=epsilon(i), xi=xi(i), &
                                                gamma=gamma(i)), &
                          block_history_type(theta=theta(i), u=u(i), v=v(i)), &
                          t_end=t_end(i), sample_interval=sample_interval(i)), &
                i=1, count(name /= ""))]
      if (allocated(error)) return
      if (any(len_trim(name) > case_name_length)) then
         call raise(error, path//": name of "//text(maxval(len_trim(name))) &
                    //" letters; expected 1 to "//text(case_name_length))
      end if
   end subroutine read_group

   !> Refuse what cannot be solved.
   pure subroutine check_case(place, case, error)
      !> File and case, for messages
      character(len=*), intent(in) :: place
      !> The case
      type(case_type), intent(in) :: case
      !> A value is out of range
      type(error_type), allocatable, intent(inout) :: error

      call case%parameters%check(place, error)
      call check_quantity(error, place, "theta", case%history%theta)
      call check_quantity(error, place, "u", case%history%u)
      call check_quantity(error, place, "v", case%history%v)
      call check_number(error, place, "t_end", case%t_end, above=0.0_wp)
      call check_number(error, place, "sample_interval", case%sample_interval, above=0.0_wp, &
                        at_most=case%t_end)
      if (allocated(error)) return
      call check_number(error, place, "number of samples t_end/sample_interval", &
                        case%t_end/case%sample_interval, at_most=most_samples)
   end subroutine check_case
end module cases_input
