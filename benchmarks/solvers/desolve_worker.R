# SPDX-License-Identifier: BSD-3-Clause
# One block in deSolve's dede, run as often as standard input asks (workers.py).
# Arguments: the library of block.c, and which interpolation of the past.
suppressPackageStartupMessages(library(deSolve))

given <- commandArgs(trailingOnly = TRUE)
library_path <- given[1]
interpolation <- as.integer(given[2])
dyn.load(library_path)
requests <- file("stdin", "r")
scene <- scan(text = readLines(requests, n = 1), quiet = TRUE)
tau <- scene[1]
past <- scene[5:7]
t_end <- scene[8]
sample_times <- seq(0, t_end, length.out = round(t_end / scene[9]) + 1)

solve_scene <- function(tolerance, times) {
  dede(past, times, "block", c(scene[1:4], past[3]),
    dllname = sub("[.]so$", "", basename(library_path)), initfunc = "set_parameters",
    rtol = tolerance, atol = tolerance, hmax = tau, maxsteps = 1e8,
    control = list(mxhist = 10000, interpol = interpolation)
  )
}

seconds_of <- function(runs, tolerance, times) {
  start <- proc.time()
  for (i in seq_len(runs)) result <- solve_scene(tolerance, times)
  spent <- sum((proc.time() - start)[1:2]) / runs
  if (nrow(result) < length(times) || attr(result, "istate")[1] < 0) stop("stopped early")
  spent
}

answer <- function(tolerance, runs, path) {
  if (runs > 0) {
    # the set-up of a call, which a run to nearly zero shows, is not the solver's
    set_up <- seconds_of(runs, tolerance, c(0, 1e-9))
    # samples make it land on each of them: slower, but sometimes the only way to the end
    spent <- tryCatch(
      seconds_of(runs, tolerance, c(0, t_end)),
      warning = function(stopped) seconds_of(runs, tolerance, sample_times),
      error = function(stopped) seconds_of(runs, tolerance, sample_times)
    )
    return(max(spent - set_up, 0))
  }
  samples <- solve_scene(tolerance, sample_times)
  write.table(format(unclass(samples), digits = 17), path, sep = "\t", quote = FALSE,
    row.names = FALSE, col.names = FALSE)
  if (nrow(samples) < length(sample_times)) stop("stopped early")
  0
}

cat("answer:", format(packageVersion("deSolve")), "\n")
while (length(line <- readLines(requests, n = 1)) > 0) {
  request <- regmatches(line, regexec("^(\\S+) (\\S+) (.*)$", line))[[1]][-1]
  said <- NULL
  note <- function(warning) {
    if (is.null(said)) said <<- conditionMessage(warning)
    invokeRestart("muffleWarning")
  }
  seconds <- tryCatch(
    withCallingHandlers(
      answer(as.numeric(request[1]), as.integer(request[2]), request[3]),
      warning = note
    ),
    error = function(failure) {
      if (is.null(said)) said <<- conditionMessage(failure)
      0
    }
  )
  status <- if (is.null(said)) "ok" else gsub("\\s+", " ", said)
  cat("answer:", format(seconds, digits = 9), status, "\n")
}
