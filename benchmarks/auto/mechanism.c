/* Right-hand side for AUTO-07p: u = (q, v), u' = (v, qacc) from MuJoCo, one control as the parameter.

   The folder holds model.mjb (the model with the load case's values) and start.txt: the control's index, the
   watched state's, the parameter's value, then qpos. Prints the time from the first evaluation to the exit, and the evaluations. */
#include <mujoco/mujoco.h>
#include <time.h>

#include "auto_f2c.h"

static mjModel *model;
static mjData *data;
static int control, watched;
static long calls;
static struct timespec first;

static void report(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  fprintf(stderr, "seconds %.9f calls %ld\n",
          (double)(now.tv_sec - first.tv_sec) + 1e-9 * (double)(now.tv_nsec - first.tv_nsec), calls);
}

static void load(void) {
  model = mj_loadModel("model.mjb", NULL);
  data = mj_makeData(model);
  clock_gettime(CLOCK_MONOTONIC, &first);
  atexit(report);
}

static int func(integer ndim, const doublereal *u, const integer *icp, const doublereal *par, integer ijac,
                doublereal *f, doublereal *dfdu, doublereal *dfdp) {
  int n = ndim / 2;
  mju_copy(data->qpos, u, n);
  mju_copy(data->qvel, u + n, n);
  data->ctrl[control] = par[0];
  mj_forward(model, data);
  mju_copy(f, u + n, n);
  mju_copy(f + n, data->qacc, n);
  calls++;
  return 0;
}

static int stpnt(integer ndim, doublereal t, doublereal *u, doublereal *par) {
  load();
  FILE *file = fopen("start.txt", "r");
  if (!file || fscanf(file, "%d %d %lf", &control, &watched, par) != 3) exit(1);
  for (int i = 0; i < ndim / 2; i++) {
    if (fscanf(file, "%lf", &u[i]) != 1) exit(1);
    u[ndim / 2 + i] = 0.0;
  }
  fclose(file);
  return 0;
}

static int bcnd(void) { return 0; }
static int icnd(void) { return 0; }
static int fopt(void) { return 0; }
static int pvls(integer ndim, const doublereal *u, doublereal *par) {
  par[1] = u[watched];
  return 0;
}
