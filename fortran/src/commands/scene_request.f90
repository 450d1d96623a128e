! SPDX-License-Identifier: BSD-3-Clause
!> A scene: a model with its parameters and its history, from the section `scene` of a namelist.
module scene_request
   use dde, only: integration_options
   use dde_errors, only: error_type
   use dde_kinds, only: wp
   use model_attributes, only: put_history, put_model
   use model_history, only: history_type
   use model_problem, only: model_type
   use natural_units, only: in_own_units
   use model_settings, only: model_settings_type
   use request, only: element_length, request_type, word_length
   use results, only: results_type
   use value_checks, only: absent, check_number, missing, most_samples
   implicit none (type, external)
   private
   public :: read_scene, scene_settings_type, scene_type

   !> Settings of a scene; all nondimensional.
   type :: scene_settings_type
      !> Name of the scene
      character(len=word_length) :: name = ""
      !> The model with its parameters
      type(model_settings_type) :: model
      !> Last time
      real(wp) :: t_end = missing
      !> Time up to which spectra and portraits leave the trajectory out
      real(wp) :: t_transient = missing
      !> Time between stored samples
      real(wp) :: sample_interval = missing
      !> Relative and absolute tolerance of one step
      real(wp) :: tolerance = missing
      !> One of the solver's methods
      character(len=word_length) :: method = ""
      !> Variables to store: states or their exponentials; all if none is given
      character(len=element_length) :: variables(32) = ""
      !> Thresholds of events; that of the definition if none is given
      real(wp) :: thresholds(4) = absent
   end type scene_settings_type

   !> A scene that can be run.
   type, extends(scene_settings_type) :: scene_type
      !> The model, with the past of the history
      type(model_type) :: problem
      !> The history
      type(history_type) :: history
   contains
      procedure :: open => open_scene
      procedure :: put => put_scene
      procedure :: options => options_of_scene
   end type scene_type

contains

   !> Read and check a scene.
   subroutine read_scene(given, opened, error)
      class(request_type), intent(inout) :: given
      type(scene_type), intent(out) :: opened
      !> It cannot be read, or a value is out of range
      type(error_type), allocatable, intent(out) :: error
      type(scene_settings_type) :: scene
      namelist /settings/ scene

      read (given%lines, nml=settings, iostat=given%status, iomsg=given%reason)
      write (given%copy, nml=settings, delim="quote")
      call given%check(error)
      call opened%open(given, scene, error)
      if (allocated(error)) return
      call check_number(error, given%place//"scene '"//trim(scene%name)//"': ", &
                        "sample_interval", scene%sample_interval, &
                        at_least=scene%t_end/most_samples*opened%problem%shape%blocks)
   end subroutine read_scene

   !> Open the model of a scene and read its history; keep an earlier error.
   subroutine open_scene(self, given, settings, error)
      class(scene_type), intent(inout) :: self
      class(request_type), intent(inout) :: given
      type(scene_settings_type), intent(in) :: settings
      !> First error met
      type(error_type), allocatable, intent(inout) :: error

      if (allocated(error)) return
      self%scene_settings_type = settings
      call self%model%open(given%place//"scene '"//trim(self%name)//"': ", self%problem, error, &
                           opened=given%model)
      call given%read_histories(self%problem, self%history, error)
   end subroutine open_scene

   !> Write name, model and history of a scene.
   subroutine put_scene(self, data)
      class(scene_type), intent(in) :: self
      class(results_type), intent(inout) :: data

      call data%attribute("scene", trim(self%name))
      call put_model(data, self%problem)
      call put_history(data, self%problem, self%history)
   end subroutine put_scene

   !> Method and tolerances for the solver.
   pure type(integration_options) function options_of_scene(self) result(options)
      class(scene_type), intent(in) :: self

      options = integration_options(method=trim(self%method), relative=self%tolerance, &
                                    absolute=self%tolerance)
      options = in_own_units(self%problem, options)
   end function options_of_scene
end module scene_request
