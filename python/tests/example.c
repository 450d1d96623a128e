/* Mackey-Glass: y(50) and y(200), of a model whose compiled object is the argument. */
#include "delaykit.h"
#include <stdio.h>

int main(int argc, char **argv) {
  char message[2048] = ""; dk_model *model; dk_results *results; int32_t n;
  if (argc != 2 || dk_open(argv[1], &model, message, sizeof message)) { puts(message); return 1; }
  double parameters[] = {0.2, 10, 0.1, 17}, past[] = {1.2}, tolerance[] = {1e-9}, times[] = {50, 200};
  dk_request request = {.parameters = parameters, .past = past, .t_end = 200, .method = "auto",
    .rtol = tolerance, .atol = tolerance, .max_step = 1e300, .max_steps = 1000000, .share = 0.25,
    .times = times, .time_count = 2, .blocks = 1, .ends = 1};
  int32_t failed = dk_integrate(model, &request, &results, message, sizeof message);
  if (failed) puts(message);
  const double *y = dk_values(results, "y", &n);
  for (int i = 0; i < n; i++) printf("%.9f\n", y[i]);
  dk_free(results); dk_close(model); return failed;
}
