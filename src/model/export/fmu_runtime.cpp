// SPDX-License-Identifier: MIT
#include "model/export/fmu_runtime.hpp"

namespace lacuna {

const char* const kFmuRuntime = R"C(
/* FMI 2.0, co-simulation. */
typedef void* fmi2Component;
typedef void* fmi2ComponentEnvironment;
typedef void* fmi2FMUstate;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer;
typedef int fmi2Boolean;
typedef char fmi2Char;
typedef char fmi2Byte;
typedef const fmi2Char* fmi2String;
typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum {
  fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated
} fmi2StatusKind;
typedef struct fmi2CallbackFunctions fmi2CallbackFunctions;

#if defined _WIN32
#define LACUNA_EXPORT __declspec(dllexport)
#else
#define LACUNA_EXPORT __attribute__((visibility("default")))
#endif

#define LACUNA_ROOM(n) ((n) > 0 ? (n) : 1)
#define LACUNA_VALUES (LACUNA_STATES + LACUNA_INPUTS + LACUNA_PARAMETERS + LACUNA_OUTPUTS)

typedef struct {
  double time, step;
  double state[LACUNA_STATES], input[LACUNA_ROOM(LACUNA_INPUTS)];
  double parameter[LACUNA_ROOM(LACUNA_PARAMETERS)];
} lacuna_instance;

static void lacuna_reset(lacuna_instance* it) {
  memset(it, 0, sizeof *it);
  memcpy(it->state, lacuna_start_states, sizeof(double) * LACUNA_STATES);
  memcpy(it->parameter, lacuna_start_parameters, sizeof(double) * LACUNA_PARAMETERS);
}

/* Dormand and Prince, J. Comput. Appl. Math. 6 (1980) 19: order 5 with an estimate of order 4. */
static const double lacuna_node[7] = {0.0, 0.2, 0.3, 0.8, 8.0/9.0, 1.0, 1.0};
static const double lacuna_weight[7][6] = {
  {0.0},
  {0.2},
  {3.0/40.0, 9.0/40.0},
  {44.0/45.0, -56.0/15.0, 32.0/9.0},
  {19372.0/6561.0, -25360.0/2187.0, 64448.0/6561.0, -212.0/729.0},
  {9017.0/3168.0, -355.0/33.0, 46732.0/5247.0, 49.0/176.0, -5103.0/18656.0},
  {35.0/384.0, 0.0, 500.0/1113.0, 125.0/192.0, -2187.0/6784.0, 11.0/84.0}};
static const double lacuna_error[7] = {
  71.0/57600.0, 0.0, -71.0/16695.0, 71.0/1920.0, -17253.0/339200.0, 22.0/525.0, -1.0/40.0};

/* One step of size h into at; the error relative to the tolerance. */
static double lacuna_try(lacuna_instance* it, double h, double at[]) {
  static const double relative = 1e-11, absolute = 1e-13;
  double rate[7][LACUNA_STATES], worst = 0.0;
  for (int s = 0; s < 7; ++s) {
    for (int k = 0; k < LACUNA_STATES; ++k) {
      double sum = 0.0;
      for (int r = 0; r < s; ++r) sum += lacuna_weight[s][r]*rate[r][k];
      at[k] = it->state[k] + h*sum;
    }
    lacuna_rate(it->time + lacuna_node[s]*h, at, it->input, rate[s], it->parameter);
  }
  for (int k = 0; k < LACUNA_STATES; ++k) {
    double error = 0.0;
    for (int s = 0; s < 7; ++s) error += lacuna_error[s]*rate[s][k];
    const double size = fmax(fabs(it->state[k]), fabs(at[k]));
    const double ratio = fabs(h*error)/(absolute + relative*size);
    if (!(ratio <= worst)) worst = ratio;
  }
  return worst;
}

/* Solves up to a time, the inputs held. Steps get no shorter than what doubles can add: a jump of
   the rates is passed by such a step. */
static fmi2Status lacuna_solve(lacuna_instance* it, double end) {
  const double begin = it->time, least = 1e-12*fmax(fabs(begin), fabs(end)) + 1e-300;
  if (!(it->step > 0.0)) it->step = (end - begin)/16.0;
  while (it->time < end) {
    const int last = it->time + it->step*(1.0 + 1e-9) >= end;
    const double h = last ? end - it->time : it->step;
    double at[LACUNA_STATES];
    const double error = lacuna_try(it, h, at);
    const int lost = error != error || error > 1e300;
    if (error <= 1.0 || (h <= least && !lost)) {
      memcpy(it->state, at, sizeof at);
      it->time = last ? end : it->time + h;
    } else if (h <= least) {
      return fmi2Error;
    }
    const double factor = lost ? 0.1 : error > 0.0 ? 0.9*pow(error, -0.2) : 5.0;
    const double next = h*fmin(5.0, fmax(0.1, factor));
    if (!last || error > 1.0 || lost || next < it->step) it->step = fmax(next, least);
  }
  return fmi2OK;
}

LACUNA_EXPORT const char* fmi2GetTypesPlatform(void) { return "default"; }
LACUNA_EXPORT const char* fmi2GetVersion(void) { return "2.0"; }

LACUNA_EXPORT fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n,
                                             const fmi2String categories[]) {
  (void)c, (void)on, (void)n, (void)categories;
  return fmi2OK;
}

LACUNA_EXPORT fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid,
                                            fmi2String resources,
                                            const fmi2CallbackFunctions* functions,
                                            fmi2Boolean visible, fmi2Boolean logging) {
  (void)name, (void)resources, (void)functions, (void)visible, (void)logging;
  if (type != fmi2CoSimulation || guid == NULL || strcmp(guid, LACUNA_GUID) != 0) return NULL;
  lacuna_instance* it = malloc(sizeof *it);
  if (it != NULL) lacuna_reset(it);
  return it;
}

LACUNA_EXPORT void fmi2FreeInstance(fmi2Component c) { free(c); }

LACUNA_EXPORT fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance,
                                             fmi2Real tolerance, fmi2Real start,
                                             fmi2Boolean has_stop, fmi2Real stop) {
  (void)has_tolerance, (void)tolerance, (void)has_stop, (void)stop;
  ((lacuna_instance*)c)->time = start;
  return fmi2OK;
}

LACUNA_EXPORT fmi2Status fmi2EnterInitializationMode(fmi2Component c) { return (void)c, fmi2OK; }
LACUNA_EXPORT fmi2Status fmi2ExitInitializationMode(fmi2Component c) { return (void)c, fmi2OK; }
LACUNA_EXPORT fmi2Status fmi2Terminate(fmi2Component c) { return (void)c, fmi2OK; }
LACUNA_EXPORT fmi2Status fmi2Reset(fmi2Component c) { return lacuna_reset(c), fmi2OK; }

/* Where a value stands; NULL for an output and for what is none. */
static double* lacuna_place(lacuna_instance* it, fmi2ValueReference i) {
  if (i < LACUNA_STATES) return &it->state[i];
  i -= LACUNA_STATES;
  if (i < LACUNA_INPUTS) return &it->input[i];
  i -= LACUNA_INPUTS;
  return i < LACUNA_PARAMETERS ? &it->parameter[i] : NULL;
}

static void lacuna_outputs(lacuna_instance* it, double output[]) {
#if LACUNA_OUTPUTS > 0
  lacuna_output(it->time, it->state, it->input, output, it->parameter);
#else
  (void)it, (void)output;
#endif
}

LACUNA_EXPORT fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference references[],
                                     size_t n, fmi2Real values[]) {
  double output[LACUNA_ROOM(LACUNA_OUTPUTS)];
  lacuna_outputs(c, output);
  for (size_t i = 0; i < n; ++i) {
    const double* place = lacuna_place(c, references[i]);
    if (place == NULL && references[i] >= LACUNA_VALUES) return fmi2Error;
    values[i] = place != NULL ? *place : output[references[i] - (LACUNA_VALUES - LACUNA_OUTPUTS)];
  }
  return fmi2OK;
}

LACUNA_EXPORT fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference references[],
                                     size_t n, const fmi2Real values[]) {
  for (size_t i = 0; i < n; ++i) {
    double* place = lacuna_place(c, references[i]);
    if (place == NULL) return fmi2Error;
    *place = values[i];
  }
  return fmi2OK;
}

/* There are no variables of other types. */
#define LACUNA_NONE(name, type) \
  LACUNA_EXPORT fmi2Status name(fmi2Component c, const fmi2ValueReference r[], size_t n, \
                                type values[]) { \
    (void)c, (void)r, (void)values; \
    return n == 0 ? fmi2OK : fmi2Error; \
  }
LACUNA_NONE(fmi2GetInteger, fmi2Integer)
LACUNA_NONE(fmi2GetBoolean, fmi2Boolean)
LACUNA_NONE(fmi2GetString, fmi2String)
LACUNA_NONE(fmi2SetInteger, const fmi2Integer)
LACUNA_NONE(fmi2SetBoolean, const fmi2Boolean)
LACUNA_NONE(fmi2SetString, const fmi2String)

LACUNA_EXPORT fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real size,
                                    fmi2Boolean no_return) {
  (void)no_return;
  if (!(size > 0.0)) return size == 0.0 ? fmi2OK : fmi2Error;
  ((lacuna_instance*)c)->time = time;
  return lacuna_solve(c, time + size);
}

LACUNA_EXPORT fmi2Status fmi2CancelStep(fmi2Component c) { return (void)c, fmi2Error; }

/* What an FMU need not have. */
LACUNA_EXPORT fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* s) {
  return (void)c, (void)s, fmi2Error;
}
LACUNA_EXPORT fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate s) {
  return (void)c, (void)s, fmi2Error;
}
LACUNA_EXPORT fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate* s) {
  return (void)c, (void)s, fmi2Error;
}
LACUNA_EXPORT fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate s, size_t* n) {
  return (void)c, (void)s, (void)n, fmi2Error;
}
LACUNA_EXPORT fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate s, fmi2Byte b[],
                                               size_t n) {
  return (void)c, (void)s, (void)b, (void)n, fmi2Error;
}
LACUNA_EXPORT fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte b[], size_t n,
                                                 fmi2FMUstate* s) {
  return (void)c, (void)s, (void)b, (void)n, fmi2Error;
}
LACUNA_EXPORT fmi2Status fmi2GetDirectionalDerivative(fmi2Component c,
                                                      const fmi2ValueReference u[], size_t n,
                                                      const fmi2ValueReference k[], size_t m,
                                                      const fmi2Real dk[], fmi2Real du[]) {
  return (void)c, (void)u, (void)n, (void)k, (void)m, (void)dk, (void)du, fmi2Error;
}
LACUNA_EXPORT fmi2Status fmi2SetRealInputDerivatives(fmi2Component c,
                                                     const fmi2ValueReference r[], size_t n,
                                                     const fmi2Integer order[],
                                                     const fmi2Real values[]) {
  return (void)c, (void)r, (void)order, (void)values, n == 0 ? fmi2OK : fmi2Error;
}
LACUNA_EXPORT fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c,
                                                      const fmi2ValueReference r[], size_t n,
                                                      const fmi2Integer order[],
                                                      fmi2Real values[]) {
  return (void)c, (void)r, (void)order, (void)values, n == 0 ? fmi2OK : fmi2Error;
}
LACUNA_EXPORT fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind k, fmi2Status* v) {
  return (void)c, (void)k, (void)v, fmi2Discard;
}
LACUNA_EXPORT fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind k, fmi2Real* v) {
  if (k != fmi2LastSuccessfulTime) return fmi2Discard;
  *v = ((lacuna_instance*)c)->time;
  return fmi2OK;
}
LACUNA_EXPORT fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind k,
                                              fmi2Integer* v) {
  return (void)c, (void)k, (void)v, fmi2Discard;
}
LACUNA_EXPORT fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind k,
                                              fmi2Boolean* v) {
  return (void)c, (void)k, (void)v, fmi2Discard;
}
LACUNA_EXPORT fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind k,
                                             fmi2String* v) {
  return (void)c, (void)k, (void)v, fmi2Discard;
}
)C";

}  // namespace lacuna
