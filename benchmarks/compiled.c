/* Right-hand side of `ab` with sigma = 3 for m states at once, u and f being (2, m): D and B are numbers, or (m,) where
   their stride is 1. */
#include <math.h>

void ab(const double *u, const double *D, long step_D, const double *B, long step_B, double *f, long m) {
  for (long i = 0; i < m; i++) {
    double conversion = D[i * step_D] * (1.0 - u[i]) * exp(u[m + i]);
    f[i] = conversion - u[i];
    f[m + i] = B[i * step_B] * conversion - (1.0 + 3.0) * u[m + i];
  }
}
