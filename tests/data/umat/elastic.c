/* Isotropic linear elasticity as a UMAT in C, and what a UMAT can do wrong, on demand.
   PROPS: E, nu and, where NPROPS = 4, what happens in an increment with DSTRAN(2) != 0 and TIME(2) > PROPS(4):
   1 STRESS(2) is NaN; 2 XIT; 3 STATEV(NSTATV + 1) is written; 4 PNEWDT = 0.5 where |DSTRAN(2)| > 1e-4; 5 STATEV(1) is
   KINC, STATEV(2) is TIME(2) + DTIME, STATEV(3) is STRAN(2) + DSTRAN(2), STATEV(4) is CMNAME(1:1)'s code;
   6 STATEV(1..3) are DSTRAN(5), DSTRAN(6), STRESS(5) and STATEV(4), STATEV(5) are STATEV(10), STATEV(16);
   7 exit(0), as STOP; 8 a write to address 8; 9 abort(); 10 a recursion that fills the stack.
   With NPROPS = 3 the stress depends on PROPS(3) = 1: DFGRD1(1,1); 2: the sign of COORDS(2) - 5; 3: both; 4: DFGRD1 in
   increments with DSTRAN(2) != 0 only; 5: CELENT. */
#include <math.h>
#include <stdlib.h>

void xit_(void);

/* Another SINV than Abaqus's: a library uses its own. */
void sinv_(double* scalar) {
  *scalar *= 2;
}

static double fill_stack(double x) {
  volatile double room[1000];
  room[0] = x;
  return fill_stack(room[0] + 1) + room[0];
}

static void misbehave(int how, double* stress, double* statev, int nstatv, const double* stran, const double* dstran,
                      const double* time, double dtime, const char* cmname, double* pnewdt, int kinc) {
  if (how == 1) stress[1] = NAN;
  if (how == 2) xit_();
  if (how == 3) statev[nstatv] = 1;
  if (how == 4 && fabs(dstran[1]) > 1e-4) *pnewdt = 0.5;
  if (how == 5) {
    statev[0] = kinc;
    statev[1] = time[1] + dtime;
    statev[2] = stran[1] + dstran[1];
    statev[3] = cmname[0];
  }
  if (how == 7) exit(0);
  if (how == 8) *(volatile double*)8 = 1;
  if (how == 9) abort();
  if (how == 10) stress[0] = fill_stack(1);
  if (how == 6) {
    statev[0] = dstran[4];
    statev[1] = dstran[5];
    statev[2] = stress[4];
    statev[3] = statev[9];
    statev[4] = statev[15];
  }
}

void umat(double* stress, double* statev, double* ddsdde, double* sse, double* spd, double* scd, double* rpl,
          double* ddsddt, double* drplde, double* drpldt, const double* stran, const double* dstran, const double* time,
          const double* dtime, const double* temp, const double* dtemp, const double* predef, const double* dpred,
          const char* cmname, const int* ndi, const int* nshr, const int* ntens, const int* nstatv, const double* props,
          const int* nprops, const double* coords, const double* drot, double* pnewdt, const double* celent,
          const double* dfgrd0, const double* dfgrd1, const int* noel, const int* npt, const int* layer, const int* kspt,
          const int* jstep, const int* kinc) {
  double half = 0.5;
  sinv_(&half); /* 1, or else another's SINV came in between */
  const double g2 = half * props[0] / (1 + props[1]), lambda = g2 * props[1] / (1 - 2 * props[1]);
  const int n = *ntens;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double isotropic = i < *ndi && j < *ndi ? lambda : 0;
      ddsdde[i + n * j] = isotropic + (i != j ? 0 : i < *ndi ? g2 : g2 / 2);
      stress[i] += ddsdde[i + n * j] * dstran[j];
    }
  }
  if (*nprops == 3) {
    const int how = (int)props[2];
    if (how == 1 || how == 3 || (how == 4 && dstran[1] != 0)) stress[0] += dfgrd1[0] - 1;
    if (how == 5) ddsdde[0] *= 1 + *celent;
    if ((how == 2 || how == 3) && coords[1] > 5) ddsdde[0] *= 2;
  }
  if (*nprops > 3 && dstran[1] != 0 && time[1] > props[3])
    misbehave((int)props[2], stress, statev, *nstatv, stran, dstran, time, *dtime, cmname, pnewdt, *kinc);
}
