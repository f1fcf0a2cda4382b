/* Right-hand side for AUTO-07p: van der Pol's oscillator u'' = mu (1 - u^2) u' - u and one of its cycles.

   The folder holds orbit.txt: mu, the period, the number of samples of one period, then u and u' of each. Prints the
   process' CPU time from the first evaluation to the exit, and the evaluations. */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "auto_f2c.h"

static int samples;
static double mu, period, *orbit;
static long calls;
static struct timespec first;

static void report(void) {
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  fprintf(stderr, "seconds %.9f calls %ld\n",
          (double)(now.tv_sec - first.tv_sec) + 1e-9 * (double)(now.tv_nsec - first.tv_nsec), calls);
}

static void load(void) {
  FILE *file = fopen("orbit.txt", "r");
  if (!file || fscanf(file, "%lf %lf %d", &mu, &period, &samples) != 3) exit(1);
  orbit = malloc(sizeof(double) * 2 * samples);
  for (int i = 0; i < 2 * samples; i++)
    if (fscanf(file, "%lf", &orbit[i]) != 1) exit(1);
  fclose(file);
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &first);
  atexit(report);
}

static int func(integer ndim, const doublereal *u, const integer *icp, const doublereal *par, integer ijac,
                doublereal *f, doublereal *dfdu, doublereal *dfdp) {
  f[0] = u[1];
  f[1] = par[0] * (1.0 - u[0] * u[0]) * u[1] - u[0];
  calls++;
  return 0;
}

static int stpnt(integer ndim, doublereal t, doublereal *u, doublereal *par) {
  if (!orbit) load();
  int at = (int)(t * samples + 0.5) % samples;
  u[0] = orbit[2 * at];
  u[1] = orbit[2 * at + 1];
  par[0] = mu;
  par[10] = period;
  return 0;
}

static int bcnd(void) { return 0; }
static int icnd(void) { return 0; }
static int fopt(void) { return 0; }
static int pvls(integer ndim, const doublereal *u, doublereal *par) { return 0; }
