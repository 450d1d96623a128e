! SPDX-License-Identifier: BSD-3-Clause
!> A model of which some parameters may vary.
module model_family
   use dde_kinds, only: wp
   use model_problem, only: model_type
   implicit none (type, external)
   private
   public :: family_type, fixed_model

   !> A model and those of its parameters that may vary.
   type :: family_type
      !> The model, which keeps delays of 0 and does not depend on time
      class(model_type), allocatable :: model
      !> Numbers of the free parameters
      integer, allocatable :: free(:)
      !> Unit of each, > 0
      real(wp), allocatable :: unit(:)
   contains
      procedure :: at => model_at
   end type family_type

   interface family_type
      module procedure :: new_family
   end interface family_type

contains

   !> A model with free parameters. gfortran 12 cannot compile the structure constructor.
   function new_family(model, free, unit) result(family)
      class(model_type), intent(in) :: model
      integer, intent(in) :: free(:)
      !> Unit of each, > 0
      real(wp), intent(in) :: unit(:)
      type(family_type) :: family

      allocate (family%model, source=model)
      family%free = free
      family%unit = unit
   end function new_family

   !> A model without a free parameter.
   type(family_type) function fixed_model(model) result(family)
      !> The model
      class(model_type), intent(in) :: model

      family = family_type(model, [integer ::], [real(wp) ::])
   end function fixed_model

   !> The model at parameters.
   subroutine model_at(self, parameters, model)
      class(family_type), intent(in) :: self
      !> All parameters, in the order of the definition
      real(wp), intent(in) :: parameters(:)
      !> The model there
      class(model_type), allocatable, intent(out) :: model

      allocate (model, source=self%model)
      call model%put(parameters)
   end subroutine model_at
end module model_family
