/* SPDX-License-Identifier: MIT
 * The C interface as a program in C calls it, compiled with what is installed. */
#include <lacuna/lacuna.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SAMPLES 2000

static void expect(int holds, const char* what) {
  if (holds) return;
  fprintf(stderr, "from_c: %s; %s\n", what, lacuna_error());
  exit(1);
}

/* x = cos 2t, v = dx/dt: dx/dt = v, dv/dt = -4 x. */
static lacuna_records* oscillator(double begin) {
  static double time[SAMPLES], states[2 * SAMPLES];
  lacuna_records* records = lacuna_records_new("x [m], v [m/s]", NULL, "s");
  int i;
  expect(records != NULL, "no records");
  for (i = 0; i < SAMPLES; ++i) {
    time[i] = 0.01 * i;
    states[2 * i] = cos(2.0 * time[i] + begin);
    states[2 * i + 1] = -2.0 * sin(2.0 * time[i] + begin);
  }
  expect(lacuna_records_add(records, SAMPLES, time, states, NULL) == 0, "not added");
  time[1] = time[0];
  expect(lacuna_records_add(records, SAMPLES, time, states, NULL) != 0, "time stands still");
  expect(strstr(lacuna_error(), "record 2") != NULL, "the error names no record");
  return records;
}

static void answers(lacuna_records* records) {
  lacuna_model* free_swing = lacuna_model_parse(
      "state x [m]\nstate v [m/s]\ndx/dt = v\n"
      "param k = 3 [1/s^2]\ndv/dt = -k*x\n");
  char *found = lacuna_identify(records, "{\"basis\": {\"max_degree\": 2}}"), *missing, *fitted;
  expect(found != NULL && strstr(found, "lacuna.identification/1") != NULL, "not identified");
  expect(free_swing != NULL, "no model");
  missing = lacuna_diagnose(free_swing, records, NULL, "");
  expect(missing != NULL && strstr(missing, "\"coefficients-only\"") != NULL, "k is off");
  fitted = lacuna_fit(free_swing, records, NULL);
  expect(fitted != NULL && strstr(fitted, "lacuna.fit/1") != NULL, "not fitted");
  lacuna_text_free(found);
  lacuna_text_free(missing);
  lacuna_text_free(fitted);
  lacuna_model_free(free_swing);
}

static void rates(void) {
  const double states[2] = {1.5, -0.5}, inputs[1] = {2.0};
  double derivatives[2];
  lacuna_model* model = lacuna_model_parse(
      "input u\nstate x\nstate v\ndx/dt = v\n"
      "dv/dt = -4*x + u\n");
  expect(model != NULL, "no model");
  expect(lacuna_model_states(model) == 2 && lacuna_model_inputs(model) == 1, "other sizes");
  expect(lacuna_model_rates(model, 0.0, states, inputs, derivatives) == 0, "no rates");
  expect(derivatives[0] == -0.5 && derivatives[1] == -4.0, "other rates");
  expect(lacuna_model_rates(model, 0.0, states, NULL, derivatives) != 0, "inputs are needed");
  lacuna_model_free(model);
}

static void mistakes(void) {
  expect(lacuna_model_parse("dx/dt = (") == NULL && *lacuna_error() != 0, "no such model");
  expect(lacuna_model_parse(NULL) == NULL, "NULL is no model");
  expect(lacuna_records_new("", NULL, "s") == NULL, "no state");
  expect(lacuna_records_read("/nowhere/at_all.csv") == NULL, "no such file");
  expect(lacuna_identify(NULL, NULL) == NULL, "NULL has no equations");
}

int main(void) {
  lacuna_records* records = oscillator(0.3);
  expect(strcmp(lacuna_version(), "0.1.0") == 0, "another version");
  expect(lacuna_identify(records, "{\"regressor\": \"no-such\"}") == NULL, "no such regressor");
  answers(records);
  rates();
  mistakes();
  lacuna_records_free(records);
  puts("from C: records, answers, rates and mistakes");
  return 0;
}
