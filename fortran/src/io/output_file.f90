! SPDX-License-Identifier: BSD-3-Clause
!> Results as NetCDF-4 files by the CF conventions, which appear only when they are complete.
module output_file
   use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_fortran_env, only: compiler_version
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use netcdf, only: nf90_char, nf90_close, nf90_create, nf90_def_dim, nf90_def_var, nf90_double, &
                     nf90_global, nf90_int, nf90_netcdf4, nf90_noerr, nf90_put_att, nf90_put_var, &
                     nf90_strerror
   use program_arguments, only: command_name
   use results, only: attribute_type, variable_type, written_type
   use unfinished_file, only: unfinished_type
   use version, only: project_version
   implicit none (type, external)
   private
   public :: output_file_type

   !> Level of compression: higher levels take longer and save at most 1 % more
   integer, parameter :: level = 4
   !> What all results are made from
   character(len=*), parameter :: paper = "S. Kostic, N. Vasovic, I. Franovic, K. Todorovic: &
                                          &Time-delay in spring-block model for aperiodicity in &
                                          &earthquakes"

   !> A file in the making. NetCDF numbers dimensions and variables as the results do.
   type, extends(written_type) :: output_file_type
      private
      !> Where it stands
      type(unfinished_type) :: place
      !> NetCDF id
      integer :: id = -1
      !> Numbers of dimensions and variables that the file has
      integer :: dimensions_written = 0, variables_written = 0
   contains
      procedure :: begin, discard, finish, write_values
      procedure, private :: define, note, put_attribute, put_implied, put_origin
   end type output_file_type

contains

   !> The file begins with the first values.
   subroutine begin(self)
      class(output_file_type), intent(inout) :: self
   end subroutine begin

   !> Write the values that are held, and what defines them where the file has not got it.
   subroutine write_values(self, first)
      class(output_file_type), intent(inout) :: self
      !> Place of the first values along the slowest dimension, if it grows
      integer, intent(in), optional :: first
      integer, allocatable :: counts(:), start(:)
      integer :: i, rows

      if (allocated(self%error)) return
      if (self%id == -1) then
         call self%place%begin(self%path, self%error)
         if (allocated(self%error)) return
         call self%note(nf90_create(self%place%part, nf90_netcdf4, self%id))
      end if
      call self%define()
      do i = 1, size(self%variables)
         associate (one => self%variables(i))
            counts = self%dimensions(one%dimensions)%length
            start = 0*counts + 1
            rows = size(counts)
            if (present(first)) start(rows) = first
            if (allocated(one%reals)) then
               if (present(first)) counts(rows) = size(one%reals)/max(1, product(counts(:rows - 1)))
               call self%note(nf90_put_var(self%id, i, one%reals, start, counts))
            else if (allocated(one%integers)) then
               call self%note(nf90_put_var(self%id, i, one%integers, start, counts))
            else if (allocated(one%letters)) then
               call self%note(nf90_put_var(self%id, i, one%letters, start, counts))
            end if
         end associate
         call drop_values(self%variables(i))
      end do
   end subroutine write_values

   !> Forget values that are written.
   subroutine drop_values(variable)
      type(variable_type), intent(inout) :: variable

      if (allocated(variable%reals)) deallocate (variable%reals)
      if (allocated(variable%integers)) deallocate (variable%integers)
      if (allocated(variable%letters)) deallocate (variable%letters)
   end subroutine drop_values

   !> Define dimensions and variables that are new. These are compressed and have a checksum, so
   !> that readers refuse damaged values.
   subroutine define(self)
      class(output_file_type), intent(inout) :: self
      character(len=:), allocatable :: coordinates
      integer :: i, id, k, kind

      do i = self%dimensions_written + 1, size(self%dimensions)
         associate (one => self%dimensions(i))
            call self%note(nf90_def_dim(self%id, trim(one%name), one%length, id))
         end associate
      end do
      do i = self%variables_written + 1, size(self%variables)
         associate (one => self%variables(i))
            kind = nf90_char
            if (allocated(one%reals)) kind = nf90_double
            if (allocated(one%integers)) kind = nf90_int
            call self%note(nf90_def_var(self%id, trim(one%name), kind, one%dimensions, id, &
                                        deflate_level=level, shuffle=.true., fletcher32=.true.))
            coordinates = ""
            do k = 1, size(one%dimensions)
               coordinates = trim(coordinates//" " &
                                  //self%dimensions(one%dimensions(k))%coordinates)
            end do
            ! those variables themselves have none
            if (index(coordinates//" ", " "//trim(one%name)//" ") > 0) coordinates = ""
            if (coordinates /= "") call self%attribute("coordinates", coordinates(2:), i)
            ! values along an axis cannot be missing
            if (kind == nf90_double .and. one%name /= self%dimensions(one%dimensions(1))%name) then
               call self%attribute("_FillValue", ieee_value(1.0_wp, ieee_quiet_nan), i)
            end if
         end associate
         do k = 1, size(self%variables(i)%attributes)
            call self%put_attribute(i, self%variables(i)%attributes(k))
            if (k == 1) call self%put_implied(i)
         end do
      end do
      self%dimensions_written = size(self%dimensions)
      self%variables_written = size(self%variables)
   end subroutine define

   !> Write what files say of a variable where results do not: letters are UTF-8, and numbers
   !> without a unit are nondimensional.
   subroutine put_implied(self, number)
      class(output_file_type), intent(inout) :: self
      integer, intent(in) :: number

      associate (one => self%variables(number))
         if (allocated(one%letters)) then
            call self%note(nf90_put_att(self%id, number, "_Encoding", "utf-8"))
         else if (all(one%attributes%name /= "units" &
                      .and. one%attributes%name /= "flag_values")) then
            call self%note(nf90_put_att(self%id, number, "units", "1"))
         end if
      end associate
   end subroutine put_implied

   !> Write an attribute.
   subroutine put_attribute(self, owner, one)
      class(output_file_type), intent(inout) :: self
      !> Number of its variable, or nf90_global
      integer, intent(in) :: owner
      type(attribute_type), intent(in) :: one

      if (allocated(one%text)) then
         call self%note(nf90_put_att(self%id, owner, trim(one%name), one%text))
      else if (allocated(one%number)) then
         call self%note(nf90_put_att(self%id, owner, trim(one%name), one%number))
      else
         call self%note(nf90_put_att(self%id, owner, trim(one%name), one%integers))
      end if
   end subroutine put_attribute

   !> Write what is left, close the file and give it its name; on an error nothing is left behind.
   subroutine finish(self)
      class(output_file_type), intent(inout) :: self
      integer :: i

      if (.not. allocated(self%dimensions)) allocate (self%dimensions(0))
      if (.not. allocated(self%variables)) allocate (self%variables(0))
      call self%write_values()
      if (allocated(self%error)) return
      call self%put_origin()
      do i = 1, size(self%attributes)
         if (self%attributes(i)%name == "title") cycle
         call self%put_attribute(nf90_global, self%attributes(i))
      end do
      if (.not. allocated(self%error)) call self%note(nf90_close(self%id))
      if (.not. allocated(self%error)) call self%place%publish("", self%error)
   end subroutine finish

   !> Write the attributes that all files have: title, and what made the file.
   subroutine put_origin(self)
      class(output_file_type), intent(inout) :: self

      call put("Conventions", "CF-1.8")
      call self%put_attribute(nf90_global, self%attributes(findloc(self%attributes%name, "title", &
                                                                   dim=1)))
      call put("institution", "the maintainers of this reproduction")
      call put("source", "program "//command_name()//" "//project_version)
      call put("history", "written by "//command_name() &
               //"; without a time, so that two runs give the same bytes")
      call put("references", paper)
      call put("program_version", project_version)
      call put("compiler", compiler_version())

   contains

      !> Write a text.
      subroutine put(name, words)
         character(len=*), intent(in) :: name, words

         call self%note(nf90_put_att(self%id, nf90_global, name, words))
      end subroutine put
   end subroutine put_origin

   !> Keep the first error and leave nothing behind.
   subroutine note(self, status)
      class(output_file_type), intent(inout) :: self
      integer, intent(in) :: status

      if (status == nf90_noerr .or. allocated(self%error)) return
      call self%place%fail(trim(nf90_strerror(status)), self%error)
      call self%discard()
   end subroutine note

   !> Leave nothing behind.
   subroutine discard(self)
      class(output_file_type), intent(inout) :: self
      integer :: status

      if (self%id == -1) return
      status = nf90_close(self%id)
      self%id = -1
      call self%place%discard()
   end subroutine discard
end module output_file
