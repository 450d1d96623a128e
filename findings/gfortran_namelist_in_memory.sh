#!/usr/bin/env bash
# gfortran 12.2 returns success for a namelist in memory of which it read nothing.
#
# Expected: a text without the wanted group gives iostat < 0, as a file does; the text of one read has no
# effect on the next.
# Seen: a text with another group alone gives 0, and values stay. So does a right text, if the read before
# it met the end of a text without the closing slash; the read after that one is right again.
# Matters: a library that is asked by texts computes with defaults after an error of another caller.
# Needs: Debian 12 with gfortran; the runtime library is unpacked, not installed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get download -qq libgfortran5=12.2.0-14+deb12u1
dpkg -x libgfortran5_*.deb .
cat >reads.f90 <<'END_OF_SOURCE'
program reads
   implicit none
   call read_text("&other n = 7 /")
   call read_text("&mine n = 7")
   call read_text("&mine n = 7 /")
   call read_text("&mine n = 7 /")
contains
   subroutine read_text(words)
      character(len=*), intent(in) :: words
      character(len=len(words)) :: lines(1)
      integer :: n, status
      namelist /mine/ n
      n = 0
      lines = words
      read (lines, nml=mine, iostat=status)
      print "(i0,1x,i0,2x,a)", status, n, words
   end subroutine read_text
end program reads
END_OF_SOURCE
gfortran -o reads reads.f90
LD_LIBRARY_PATH=$(dirname "$(find . -name libgfortran.so.5)") ./reads | tee found
cut -d ' ' -f 1,2 found | diff - <(printf '%s\n' '0 0' '-1 7' '0 0' '0 7') || exit 1
