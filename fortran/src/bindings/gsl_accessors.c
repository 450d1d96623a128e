#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>

enum { found, no_memory, same_signs, no_convergence };

/* Root of f between lower and upper by Brent's method: most iterations, relative width of the last
 * bracket. GSL would stop the program at an error: its handler is off. */
int find_root_by_brent(double (*f)(double, void *), void *params, double lower, double upper,
                       int most, double relative, double *root) {
    gsl_function function = {f, params};
    gsl_set_error_handler_off();
    gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
    if (!solver)
        return no_memory;
    int outcome = no_convergence;
    if (gsl_root_fsolver_set(solver, &function, lower, upper) != GSL_SUCCESS)
        outcome = same_signs;
    for (int i = 0; i < most && outcome == no_convergence; i++) {
        int status = gsl_root_fsolver_iterate(solver);
        *root = gsl_root_fsolver_root(solver);
        if (status == GSL_SUCCESS &&
            gsl_root_test_interval(gsl_root_fsolver_x_lower(solver), gsl_root_fsolver_x_upper(solver),
                                   0.0, relative) == GSL_SUCCESS)
            outcome = found;
    }
    gsl_root_fsolver_free(solver);
    return outcome;
}
