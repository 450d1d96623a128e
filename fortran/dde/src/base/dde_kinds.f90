! SPDX-License-Identifier: BSD-3-Clause
!> The kinds of number used everywhere.
module dde_kinds
   use, intrinsic :: iso_fortran_env, only: int64, real64
   implicit none (type, external)
   private
   public :: int64, wp

   !> Working precision of every real number of the project.
   integer, parameter :: wp = real64
end module dde_kinds
