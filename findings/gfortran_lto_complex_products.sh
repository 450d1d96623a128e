#!/usr/bin/env bash
# gfortran 12.2 multiplies complex numbers by the rules of C where -flto optimises across modules.
#
# Expected: -flto gives products by the rules of Fortran, as without it.
# Seen: a product that is not a number calls __muldc3, as in C; with -fcx-fortran-rules at the link none does, with
# that option at the compilation alone it does.
# Matters: products of complex linear systems are tested one by one (232 calls in a program of ours, 4 % of its work).
# Needs: Debian 12 with gfortran; the compiler is unpacked, not installed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get download -qq gfortran-12=12.2.0-14+deb12u1 gcc-12=12.2.0-14+deb12u1
for package in *.deb; do
    dpkg -x "$package" .
done
cat >multiply.f90 <<'END_OF_SOURCE'
subroutine multiply(n, a, b)
   implicit none
   integer, intent(in) :: n
   complex(kind(1d0)), intent(in) :: a(n)
   complex(kind(1d0)), intent(inout) :: b(n)
   b = a*b
end subroutine multiply
END_OF_SOURCE
cat >main.f90 <<'END_OF_SOURCE'
program main
   implicit none
   complex(kind(1d0)) :: a(3), b(3)
   external :: multiply
   read (*, *) a, b
   call multiply(3, a, b)
   print *, b
end program main
END_OF_SOURCE
calls_with() {
    local link=$1
    shift
    usr/bin/x86_64-linux-gnu-gfortran-12 -O2 "$@" -c main.f90 multiply.f90
    # shellcheck disable=SC2086
    usr/bin/x86_64-linux-gnu-gfortran-12 -O2 $link -r -flinker-output=nolto-rel main.o multiply.o -o linked
    nm linked | awk '/__muldc3/ {calls++} END {print calls + 0}'
}
{
    echo "without: $(calls_with '')"
    echo "-flto: $(calls_with -flto -flto)"
    echo "-flto, rules of Fortran compiled: $(calls_with -flto -flto -fcx-fortran-rules)"
    echo "-flto, rules of Fortran linked: $(calls_with '-flto -fcx-fortran-rules' -flto)"
} | tee found
diff found - <<'END_OF_OUTPUT' || exit 1
without: 0
-flto: 1
-flto, rules of Fortran compiled: 1
-flto, rules of Fortran linked: 0
END_OF_OUTPUT
