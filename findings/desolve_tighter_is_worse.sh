#!/usr/bin/env bash
# deSolve 1.34 is less accurate with tighter tolerances where a delay equation has few output times.
#
# Expected: y' = -y(t - 1) with history 1, by dede: a smaller tolerance gives a smaller error.
# Seen: at output times 0, 1, ..., 10 the largest error is 3e-6 at 1e-6 and 9e-5 at 1e-12, without a
# message. With interpol = 2, or with output each 0.01, it falls to 5e-12.
# Matters: the usual test of an accuracy, a run with a tighter tolerance, changes a right digit.
# Needs: Debian 12 with r-base-core; the package is unpacked, not installed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get download -qq r-cran-desolve=1.34-1
dpkg -x r-cran-desolve_*.deb .
cat >run.R <<'R'
library(deSolve)
exact <- function(t) sapply(t, function(s) {
    k <- 0:(floor(s) + 1)
    sum((-1)^k * pmax(s - k + 1, 0)^k / factorial(k))
})
rate <- function(t, y, p) list(if (t < 1) -1 else -lagvalue(t - 1))
largest <- function(tolerance, interpol, step) {
    t <- seq(0, 10, by = step)
    how <- list(interpol = interpol)
    run <- dede(c(y = 1), t, rate, NULL, rtol = tolerance, atol = tolerance, control = how)
    max(abs(run[, "y"] - exact(t)))
}
errors <- c(largest(1e-6, 1, 1), largest(1e-12, 1, 1), largest(1e-12, 2, 1), largest(1e-12, 1, 0.01))
print(errors)
if (!(errors[1] < 1e-5 && errors[2] > 5e-5 && all(errors[3:4] < 1e-10))) quit(status = 1)
R
R_LIBS=$folder/usr/lib/R/site-library Rscript run.R
