/* SPDX-License-Identifier: MIT
 *
 * lacuna from C, and from all that calls C: records in, answers out as JSON.
 *
 * Texts are UTF-8 and end with a zero; names are lists with units, "x [m], v [m/s]". A function
 * that fails gives NULL, or a number other than 0, and lacuna_error() says what, where and what
 * to do. Objects are made and freed by the caller; a text is freed by lacuna_text_free().
 * Different threads may work with different objects, and read one object at the same time. */
#ifndef LACUNA_LACUNA_H
#define LACUNA_LACUNA_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What lacuna_version() gives: "0.1.0". */
const char* lacuna_version(void);

/* Why the last call of this thread that failed did; "" before any did. It holds until the next.
 */
const char* lacuna_error(void);

/* Frees a text that a function gave; NULL is let be. */
void lacuna_text_free(char* text);

/* Records of one system, one or many. */
typedef struct lacuna_records lacuna_records;

/* No records yet of m states and p inputs.
 * time_unit: "s", "ms", "day". inputs may be NULL or empty. */
lacuna_records* lacuna_records_new(const char* states, const char* inputs,
                                   const char* time_unit);

/* Records from a file, as the command line reads them: text, .npy, .mat, HDF5, workbooks. Columns are
 * states; a model finds its states and inputs among them by name. */
lacuna_records* lacuna_records_read(const char* path);

/* One record more: n increasing times, states n x m and inputs n x p, row after row; inputs may
 * be NULL where there are none. */
int lacuna_records_add(lacuna_records* records, size_t samples, const double* time,
                       const double* states, const double* inputs);

void lacuna_records_free(lacuna_records* records);

/* A model: equations for the rates of m states in p inputs. */
typedef struct lacuna_model lacuna_model;

/* A model from its text, JSON of the format "lacuna.model/1" or statements, one a line:
 * "state x [m]\ndx/dt = -2*x". */
lacuna_model* lacuna_model_parse(const char* text);

/* m and p. */
size_t lacuna_model_states(const lacuna_model* model);
size_t lacuna_model_inputs(const lacuna_model* model);

/* The rates dx/dt, m numbers, at time t in states (m) under inputs (p; NULL where there are
 * none). It fails for models with delays, whose rates depend on earlier states. */
int lacuna_model_rates(const lacuna_model* model, double t, const double* states,
                       const double* inputs, double* rates);

void lacuna_model_free(lacuna_model* model);

/* The equations of records, JSON of the format "lacuna.identification/1".
 * configuration: JSON as `lacuna identify --config` reads it; NULL or "" for the defaults. */
char* lacuna_identify(const lacuna_records* records, const char* configuration);

/* What a model lacks, JSON of the format "lacuna.diagnosis/1".
 * held_out: records on which the gap is measured; NULL: the last quarter of each record.
 * configuration: JSON as `lacuna diagnose --config` reads it; NULL or "" for the defaults. */
char* lacuna_diagnose(const lacuna_model* model, const lacuna_records* records,
                      const lacuna_records* held_out, const char* configuration);

/* The free parameters of a model, JSON of the format "lacuna.fit/1".
 * held_out: records that are predicted; NULL: none. */
char* lacuna_fit(const lacuna_model* model, const lacuna_records* records,
                 const lacuna_records* held_out);

#ifdef __cplusplus
}
#endif

#endif
