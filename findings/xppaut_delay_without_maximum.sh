#!/usr/bin/env bash
# XPPAUT 6.11b solves another equation where a file declares no maximal delay.
#
# Expected: y' = -y(t - 1) with history 1 has y(10) = 0.0202; or a message that the delay is too long.
# Seen: without the option delay, delay(y,1) is y(t) itself: the run ends as any other, with exp(-10).
# With it, y(10) is 0.0329 by Runge-Kutta of order 4 at a step of 0.05: the delayed term is of order 1.
# Matters: a file that lacks one word gives a smooth curve of an equation without delay.
# Needs: Debian 12 with libx11-6; the package is unpacked, not installed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get download -qq xppaut=6.11b+1.dfsg-1.1
dpkg -x xppaut_*.deb .
for case in " 4.53999e-05" ",delay=2 0.0328824"; do
    read -r option expected <<<"x$case"
    printf '%s\n' "y'=-delay(y,1)" 'y(0)=1' "@ total=10,dt=.05,meth=rungekutta${option#x}" done >model.ode
    usr/bin/xppaut model.ode -silent -outfile out.dat >log 2>&1
    found=$(awk '$1 == 10 { print $2 }' out.dat)
    printf 'options "%s": y(10) = %s\n' "${option#x}" "$found"
    awk -v a="$found" -v b="$expected" 'BEGIN { exit !(a/b > 0.999 && a/b < 1.001) }' || exit 1
    if grep -qi 'too long\|too large\|error' log; then exit 1; fi
done
