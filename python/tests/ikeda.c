/* SPDX-License-Identifier: BSD-3-Clause */
/* Ikeda's equation y' = -y + mu sin(y(t - tau)) from C: ikeda OBJECT prints times and states. */
#include <math.h>
#include <stdio.h>
#include "delaykit.h"

int main(int count, char **arguments)
{
    const double parameters[] = {acos(0.0), 3.0}; /* mu, tau */
    const double past = 1.0, tolerance = 1e-9, times[] = {3.0, 60.0};
    const dk_request request = {
        .parameters = parameters,
        .past = &past,
        .t_end = 60.0,
        .method = "auto",
        .rtol = &tolerance,
        .atol = &tolerance,
        .max_step = 60.0,
        .max_steps = 100000,
        .max_bytes = 1e9,
        .times = times,
        .time_count = 2,
        .blocks = 1,
        .ends = 1,
    };
    char message[1000] = "usage: ikeda OBJECT";
    dk_model *model;
    dk_results *results;
    int32_t failed, number;

    if (count != 2 || dk_open(arguments[1], "", &model, message, sizeof message)) {
        fprintf(stderr, "%s\n", message);
        return 1;
    }
    failed = dk_integrate(model, &request, &results, message, sizeof message);
    if (failed)
        fprintf(stderr, "%s\n", message);
    const double *t = dk_values(results, "t", &number);
    const double *y = dk_values(results, "y", &number);
    for (int32_t i = 0; i < number; i++)
        printf("%.15g %.15g\n", t[i], y[i]);
    dk_free(results);
    dk_close(model);
    return failed;
}
