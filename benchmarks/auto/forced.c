/* Right-hand side for AUTO-07p: u = (q, v, x, y), u' = (v, qacc, an oscillator whose x is cos(w t)), forced motion.

   The folder holds model.mjb and orbit.txt: the control's index, its mean and amplitude, w, the number of samples of one
   period, then q and v of each. Prints the process' CPU time from the first evaluation to the exit, and the evaluations. */
#include <mujoco/mujoco.h>
#include <time.h>

#include "auto_f2c.h"

static mjModel *model;
static mjData *data;
static int control, samples;
static double mean, amplitude, frequency, *orbit;
static long calls;
static struct timespec first;

static void report(void) {
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  fprintf(stderr, "seconds %.9f calls %ld\n",
          (double)(now.tv_sec - first.tv_sec) + 1e-9 * (double)(now.tv_nsec - first.tv_nsec), calls);
}

static void load(int n) {
  model = mj_loadModel("model.mjb", NULL);
  data = mj_makeData(model);
  FILE *file = fopen("orbit.txt", "r");
  if (!file || fscanf(file, "%d %lf %lf %lf %d", &control, &mean, &amplitude, &frequency, &samples) != 5) exit(1);
  orbit = malloc(sizeof(double) * n * samples);
  for (int i = 0; i < n * samples; i++)
    if (fscanf(file, "%lf", &orbit[i]) != 1) exit(1);
  fclose(file);
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &first);
  atexit(report);
}

static int func(integer ndim, const doublereal *u, const integer *icp, const doublereal *par, integer ijac,
                doublereal *f, doublereal *dfdu, doublereal *dfdp) {
  int n = (ndim - 2) / 2;
  double x = u[2 * n], y = u[2 * n + 1], pull = 1.0 - x * x - y * y;
  mju_copy(data->qpos, u, n);
  mju_copy(data->qvel, u + n, n);
  data->ctrl[control] = mean + amplitude * x;
  mj_forward(model, data);
  mju_copy(f, u + n, n);
  mju_copy(f + n, data->qacc, n);
  f[2 * n] = pull * x - par[0] * y;
  f[2 * n + 1] = pull * y + par[0] * x;
  calls++;
  return 0;
}

static int stpnt(integer ndim, doublereal t, doublereal *u, doublereal *par) {
  int n = ndim - 2;
  if (!model) load(n);
  int at = (int)(t * samples + 0.5) % samples;
  mju_copy(u, orbit + n * at, n);
  u[n] = cos(2.0 * mjPI * t);
  u[n + 1] = sin(2.0 * mjPI * t);
  par[0] = frequency;
  par[10] = 2.0 * mjPI / frequency;
  return 0;
}

static int bcnd(void) { return 0; }
static int icnd(void) { return 0; }
static int fopt(void) { return 0; }
static int pvls(integer ndim, const doublereal *u, doublereal *par) { return 0; }
