! SPDX-License-Identifier: BSD-3-Clause
!> Levels of the signal of a model, as its definition says or at rest.
module model_levels
   use dde_kinds, only: wp
   use model_description, only: at_rest
   use model_problem, only: model_type
   implicit none (type, external)
   private
   public :: event_level, rest_level, section_level

contains

   !> Value of the signal's component at rest.
   pure real(wp) function rest_level(model) result(level)
      !> The model
      class(model_type), intent(in) :: model
      real(wp) :: state(model%n)

      state = model%steady_state()
      level = state(model%sizes%observed%component)
   end function rest_level

   !> Value of the signal's component in the section.
   pure real(wp) function section_level(model) result(level)
      !> The model
      class(model_type), intent(in) :: model

      level = model%sizes%observed%section
      if (level >= at_rest) level = rest_level(model)
   end function section_level

   !> Value of the signal's component above which there is an event.
   pure real(wp) function event_level(model) result(level)
      !> The model
      class(model_type), intent(in) :: model

      level = model%sizes%observed%event
      if (level >= at_rest) level = rest_level(model)
   end function event_level
end module model_levels
