/* SPDX-License-Identifier: BSD-3-Clause */
/* Right-hand side of equation (4) in theta, u, w = ln v for deSolve. */
#include <R.h>
#include <R_ext/Rdynload.h>

/* tau, epsilon, xi, gamma, w for t <= 0 */
static double parameters[5];

typedef void lag_function(double t, int *component, int count, double *value);

void set_parameters(void (*fill)(int *, double *))
{
    int count = 5;
    fill(&count, parameters);
}

void block(int *n, double *t, double *y, double *dydt, double *out, int *numbers)
{
    static lag_function *lagvalue = NULL;
    const double tau = parameters[0], epsilon = parameters[1], xi = parameters[2],
                 gamma = parameters[3], theta = y[0], u = y[1], w = y[2];
    double v = exp(w), delayed_w = w;
    int place_of_w = 2;

    (void)n, (void)out, (void)numbers;
    if (lagvalue == NULL)
        lagvalue = (lag_function *)R_GetCCallable("deSolve", "lagvalue");
    if (tau > 0 && *t <= tau)
        delayed_w = parameters[4];
    if (tau > 0 && *t > tau)
        lagvalue(*t - tau, &place_of_w, 1, &delayed_w);
    dydt[0] = -v * (theta + (1 + epsilon) * delayed_w);
    dydt[1] = v - 1;
    dydt[2] = -gamma * gamma / v * (u + (theta + w) / xi);
}
