!> A module of the user's own with a name that other projects have, too.
module kinds
   implicit none
   private
   public :: wp

   !> Single precision, another kind than the solver's.
   integer, parameter :: wp = kind(1.0)
end module kinds
