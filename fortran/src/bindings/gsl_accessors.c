/* Binding a global of GSL with bind(c) would define a null symbol: reach it through a function. */
#include <gsl/gsl_roots.h>

const gsl_root_fsolver_type *brent_of_gsl(void) { return gsl_root_fsolver_brent; }
