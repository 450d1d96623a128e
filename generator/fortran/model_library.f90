! SPDX-License-Identifier: BSD-3-Clause
!> Compiled models, opened by name: shared objects NAME.so in a folder. The folders are those of the
!> environment variable `MODELS`, with colons between them, or else the folder `models` beside that
!> of the program (`models_quad` of a program in quadruple precision). A namelist's comes first.
module model_library
   use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_f_procpointer, c_funptr, &
                                          c_null_char, c_ptr, c_size_t
   use dde_errors, only: error_type, raise
   use dde_kinds, only: wp
   use model_border, only: describe_line, expand, expand_tangents, find_delayed, find_exponents, &
                           find_forms, find_jacobian, find_network_lags, find_rate, find_rhs, &
                           find_state, letters => line_length, list_terms
   use model_code, only: code_type
   use model_description, only: description_type, word_length
   use model_network, only: read_network
   use model_interface, only: interface_digest
   use model_problem, only: model_type
   implicit none (type, external)
   private
   public :: list_models, open_model, open_object, path_of_model

   !> Letters of paths, and of lists of names.
   integer, parameter :: path_length = 4096
   !> What names of models are made of.
   character(len=*), parameter :: &
      letters_of_names = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_"

   interface
      type(c_ptr) function model_open(path, reason, length) result(library) bind(c)
         import :: c_char, c_ptr, c_size_t
         implicit none (type, external)
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(inout) :: reason(*)
         integer(c_size_t), value :: length
      end function model_open

      type(c_funptr) function dlsym(library, name) result(address) bind(c)
         import :: c_char, c_funptr, c_ptr
         implicit none (type, external)
         type(c_ptr), value :: library
         character(kind=c_char), intent(in) :: name(*)
      end function dlsym

      subroutine model_program(path, length) bind(c)
         import :: c_char, c_size_t
         implicit none (type, external)
         character(kind=c_char), intent(out) :: path(*)
         integer(c_size_t), value :: length
      end subroutine model_program

      subroutine model_list(folder, names, length) bind(c)
         import :: c_char, c_size_t
         implicit none (type, external)
         character(kind=c_char), intent(in) :: folder(*)
         character(kind=c_char), intent(inout) :: names(*)
         integer(c_size_t), value :: length
      end subroutine model_list
   end interface

contains

   !> Open a compiled model by its name. It has no parameters yet.
   subroutine open_model(name, model, error)
      !> Name of the definition
      character(len=*), intent(in) :: name
      !> The model
      type(model_type), intent(out) :: model
      !> Error if there is no model of this name, or one that does not fit this program
      type(error_type), allocatable, intent(out) :: error
      character(len=:), allocatable :: path

      path = path_of_model(name)
      if (path == "") then
         call raise(error, "no model '"//name//"' in "//model_folders())
         return
      end if
      call open_object(path, model, error)
   end subroutine open_model

   !> Open a compiled model by the path of its object. It has no parameters yet. The nodes and edges
   !> of a network are in a file NAME.network beside the object NAME.so, or in another one.
   subroutine open_object(path, model, error, network)
      !> Path of the object
      character(len=*), intent(in) :: path
      !> The model
      type(model_type), intent(out) :: model
      !> Error if it cannot be opened, or does not fit this program
      type(error_type), allocatable, intent(out) :: error
      !> Path of the file of its network
      character(len=*), intent(in), optional :: network
      character(kind=c_char, len=path_length) :: reason
      type(c_ptr) :: library
      type(description_type) :: about

      library = model_open(path//c_null_char, reason, int(path_length, c_size_t))
      if (.not. c_associated(library)) then
         call raise(error, path//": cannot be opened: "//reason(:index(reason, c_null_char) - 1) &
                    //"; compile the model again")
         return
      end if
      if (has(library, "description")) then
         call c_f_procpointer(procedure_of(library, "description"), model%code%description)
      end if
      if (.not. fits(model%code%description)) then
         call raise(error, path//": is no model for this program; compile it again")
         return
      end if
      call find_procedures(library, model%code)
      about = model%describe()
      model%sizes = about%sizes
      model%names = about%parameters%name
      model%above = about%parameters%above
      model%at_least = about%parameters%at_least
      if (.not. allocated(model%sizes%needed)) return
      if (present(network)) then
         call read_network(network, model%sizes, model%left, model%right, model%of_network, error)
      else
         call read_network(path(:index(path, ".so", back=.true.))//"network", model%sizes, &
                           model%left, model%right, model%of_network, error)
      end if
   end subroutine open_object

   !> Names of the models that there are with a beginning, without this.
   function list_models(beginning) result(names)
      !> How the names begin
      character(len=*), intent(in) :: beginning
      character(len=word_length), allocatable :: names(:)
      character(kind=c_char, len=path_length) :: found
      character(len=:), allocatable :: rest
      integer :: at, i

      found = c_null_char
      rest = model_folders()//":"
      do while (len(rest) > 0)
         at = index(rest, ":")
         call model_list(rest(:at - 1)//c_null_char, found, int(path_length, c_size_t))
         rest = rest(at + 1:)
      end do
      at = index(found, c_null_char)
      ! a blank is before each name
      allocate (names(count([(found(i:i) == " ", i=1, at)])))
      if (size(names) > 0) read (found(:at - 1), *) names
      names = pack(names, index(names, beginning) == 1)
      do i = 1, size(names)
         names(i) = names(i) (len(beginning) + 1:)
      end do
   end function list_models

   !> Path of the object of a model; empty if there is none. A name is no path.
   function path_of_model(name) result(path)
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: path, rest
      integer :: at
      logical :: there

      path = ""
      if (verify(name, letters_of_names) > 0) return
      rest = model_folders()//":"
      do while (len(rest) > 0)
         at = index(rest, ":")
         path = rest(:at - 1)//"/"//name//".so"
         inquire (file=path, exist=there)
         if (there) return
         rest = rest(at + 1:)
      end do
      path = ""
   end function path_of_model

   !> The folders of models, with colons between them.
   function model_folders() result(folders)
      character(len=:), allocatable :: folders
      character(len=path_length) :: value
      character(kind=c_char, len=path_length) :: program
      integer :: length

      call get_environment_variable("MODELS", value, length)
      if (length > 0) then
         folders = trim(value)
         return
      end if
      call model_program(program, int(path_length, c_size_t))
      folders = program(:index(program, c_null_char) - 1)
      folders = folders(:index(folders, "/", back=.true.) - 1)
      folders = folders(:index(folders, "/", back=.true.))//"models" &
                //merge("_quad", "     ", storage_size(1.0_wp) > 64)
      folders = trim(folders)
   end function model_folders

   !> Whether a description begins with the digest and the kind of reals of this program.
   logical function fits(description) result(value)
      procedure(describe_line), pointer, intent(in) :: description
      character(len=*), parameter :: &
         expected = interface_digest//" "//achar(iachar("0") + storage_size(1.0_wp)/32)
      character(kind=c_char) :: text(letters)
      integer :: i

      value = .false.
      if (.not. associated(description)) return
      if (description(1, text) /= len(expected)) return
      value = all([(text(i) == expected(i:i), i=1, len(expected))])
   end function fits

   !> All procedures of a model.
   subroutine find_procedures(library, code)
      type(c_ptr), intent(in) :: library
      type(code_type), intent(inout) :: code

      call c_f_procpointer(procedure_of(library, "rhs"), code%rhs)
      call c_f_procpointer(procedure_of(library, "delayed"), code%delayed)
      call c_f_procpointer(procedure_of(library, "exponents"), code%exponents)
      if (has(library, "moving_lags")) then
         call c_f_procpointer(procedure_of(library, "moving_lags"), code%moving_lags)
      end if
      if (has(library, "network_lags")) then
         call c_f_procpointer(procedure_of(library, "network_lags"), code%network_lags)
      end if
      if (has(library, "switching")) then
         call c_f_procpointer(procedure_of(library, "switching"), code%switching)
      end if
      if (has(library, "act")) call c_f_procpointer(procedure_of(library, "act"), code%act)
      if (has(library, "jacobian")) then
         call c_f_procpointer(procedure_of(library, "jacobian"), code%jacobian)
      end if
      if (has(library, "series")) then
         call c_f_procpointer(procedure_of(library, "series"), code%series)
         call c_f_procpointer(procedure_of(library, "tangent_series"), code%tangent_series)
      end if
      if (has(library, "relaxation_rate")) then
         call c_f_procpointer(procedure_of(library, "relaxation_rate"), code%relaxation_rate)
         call c_f_procpointer(procedure_of(library, "slow_series"), code%slow_series)
         call c_f_procpointer(procedure_of(library, "slow_tangent_series"), &
                              code%slow_tangent_series)
      end if
      if (has(library, "steady_state")) then
         call c_f_procpointer(procedure_of(library, "steady_state"), code%steady_state)
         if (has(library, "derivative")) then
            call c_f_procpointer(procedure_of(library, "derivative"), code%derivative)
         end if
         call c_f_procpointer(procedure_of(library, "characteristic_terms"), &
                              code%characteristic_terms)
      end if
   end subroutine find_procedures

   logical function has(library, name) result(value)
      type(c_ptr), intent(in) :: library
      character(len=*), intent(in) :: name

      value = c_associated(procedure_of(library, name))
   end function has

   !> The address of a procedure of a model; null if it has none.
   type(c_funptr) function procedure_of(library, name) result(address)
      type(c_ptr), intent(in) :: library
      character(len=*), intent(in) :: name

      address = dlsym(library, "model_"//name//c_null_char)
   end function procedure_of
end module model_library
