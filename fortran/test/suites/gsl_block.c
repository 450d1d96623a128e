/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The spring block without delay, equation (3) of the paper, in v and not in ln v, integrated by
   GSL: Prince and Dormand's pair 8(9), which shares no coefficient with ours. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <math.h>

struct block {
    double epsilon, xi, gamma;
};

static int equation_3(double t, const double y[], double dydt[], void *parameters) {
    const struct block *p = parameters;
    const double theta = y[0], u = y[1], v = y[2];
    (void)t;
    if (!(v > 0.0))
        return GSL_EDOM;
    dydt[0] = -v * (theta + (1.0 + p->epsilon) * log(v));
    dydt[1] = v - 1.0;
    dydt[2] = -p->gamma * p->gamma * (u + (theta + log(v)) / p->xi);
    return GSL_SUCCESS;
}

/* theta, u, v at each of n ascending times, from (theta, u, v) = start at t = 0; GSL's status. */
int integrate_by_gsl(double epsilon, double xi, double gamma, double tolerance,
                     const double start[3], int n, const double time[], double states[]) {
    struct block parameters = {epsilon, xi, gamma};
    gsl_odeiv2_system block = {equation_3, NULL, 3, &parameters};
    gsl_odeiv2_driver *driver = gsl_odeiv2_driver_alloc_y_new(&block, gsl_odeiv2_step_rk8pd, 1e-6,
                                                              tolerance, tolerance);
    double t = 0.0, y[3] = {start[0], start[1], start[2]};
    int status = GSL_SUCCESS;
    for (int i = 0; i < n && status == GSL_SUCCESS; i++) {
        status = gsl_odeiv2_driver_apply(driver, &t, time[i], y);
        for (int j = 0; j < 3; j++)
            states[3 * i + j] = y[j];
    }
    gsl_odeiv2_driver_free(driver);
    return status;
}
