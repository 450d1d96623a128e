#!/usr/bin/env bash
# gfortran 12.2 gives a name that is associated with a part of a word the length of the whole word.
#
# Expected: associate (value => self%words(1)(3:)) has len(value) = 6, where words have 8 letters and are an
# allocatable component, as it has where words are a local array.
# Seen: 8 and 6; the two letters more are those of the next word. gfortran 14.2 gives 6 and 6.
# Matters: a search in the part finds what stands in the next line of a text.
# Needs: Debian 12 with gfortran; the compiler is unpacked, not installed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get download -qq gfortran-12=12.2.0-14+deb12u1
dpkg -x gfortran-12_*.deb .
cat >part.f90 <<'END_OF_SOURCE'
module texts
   implicit none
   type :: text_type
      character(len=8), allocatable :: words(:)
   end type text_type
contains
   subroutine show(self)
      class(text_type), intent(in) :: self
      character(len=8) :: words(2)
      words = self%words
      associate (value => self%words(1) (3:), local => words(1) (3:))
         print "(i0, 1x, i0)", len(value), len(local)
      end associate
   end subroutine show
end module texts
program part
   use texts, only: show, text_type
   implicit none
   call show(text_type(["a=1     ", "b=2     "]))
end program part
END_OF_SOURCE
usr/bin/x86_64-linux-gnu-gfortran-12 -c part.f90
gfortran -o part part.o
./part | tee found
diff found <(echo '8 6') || exit 1
