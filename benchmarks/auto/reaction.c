/* AUTO-07p's demo ab with B = 14, sigma = 3; prints the time from the first evaluation to the exit. */
#include <time.h>

#include "auto_f2c.h"

static long calls;
static struct timespec first;

static void report(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  fprintf(stderr, "seconds %.9f calls %ld\n",
          (double)(now.tv_sec - first.tv_sec) + 1e-9 * (double)(now.tv_nsec - first.tv_nsec), calls);
}

static int func(integer ndim, const doublereal *u, const integer *icp, const doublereal *par, integer ijac,
                doublereal *f, doublereal *dfdu, doublereal *dfdp) {
  doublereal conversion = par[0] * (1.0 - u[0]) * exp(u[1]);
  f[0] = conversion - u[0];
  f[1] = 14.0 * conversion - (1.0 + 3.0) * u[1];
  calls++;
  return 0;
}

static int stpnt(integer ndim, doublereal t, doublereal *u, doublereal *par) {
  clock_gettime(CLOCK_MONOTONIC, &first);
  atexit(report);
  par[0] = u[0] = u[1] = 0.0;
  return 0;
}

static int bcnd(void) { return 0; }
static int icnd(void) { return 0; }
static int fopt(void) { return 0; }
static int pvls(integer ndim, const doublereal *u, doublereal *par) {
  par[1] = u[0];
  return 0;
}
