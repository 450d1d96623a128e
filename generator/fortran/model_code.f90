! SPDX-License-Identifier: BSD-3-Clause
!> The procedures of a compiled model.
module model_code
   use model_border, only: change_state, describe_line, expand, expand_tangents, find_delayed, &
                           find_exponents, find_forms, find_jacobian, find_lags, &
                           find_network_lags, find_rate, find_rhs, find_state, list_terms
   implicit none (type, external)
   private
   public :: code_type

   !> Their addresses. Those that it has not are not associated.
   type :: code_type
      procedure(describe_line), pointer, nopass :: description => null()
      procedure(find_rhs), pointer, nopass :: rhs => null()
      procedure(find_jacobian), pointer, nopass :: jacobian => null()
      procedure(find_exponents), pointer, nopass :: exponents => null(), switching => null()
      procedure(change_state), pointer, nopass :: act => null()
      procedure(expand), pointer, nopass :: series => null(), slow_series => null()
      procedure(expand_tangents), pointer, nopass :: tangent_series => null(), &
                                                     slow_tangent_series => null()
      procedure(find_rate), pointer, nopass :: relaxation_rate => null()
      procedure(find_delayed), pointer, nopass :: delayed => null()
      procedure(find_lags), pointer, nopass :: moving_lags => null()
      procedure(find_network_lags), pointer, nopass :: network_lags => null()
      procedure(find_state), pointer, nopass :: steady_state => null()
      procedure(find_forms), pointer, nopass :: derivative => null()
      procedure(list_terms), pointer, nopass :: characteristic_terms => null()
   end type code_type
end module model_code
