// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/data/dataset.hpp"
#include "lacuna/diagnosis/diagnosis.hpp"
#include "lacuna/report/identification_report.hpp"
#include "lacuna/report/page.hpp"
#include "lacuna/report/sync_report.hpp"

namespace lacuna {

/// An identification as a page: equations, how well they fit, the record beside the model that
/// runs freely in windows of it, coefficients, orbit, what became of every candidate term.
/// @param data what was identified, in the states of the model.
Page identification_page(const IdentificationReport& report, const Dataset& data);

/// A diagnosis as a page: verdict, what is missing with its numbers, records that chose nothing
/// beside the model before and after, where they disagree, coefficients, rivals, notes.
Page diagnosis_page(const Diagnosis& diagnosis);

/// A synchronisation as a page: verdict, the record beside the slave, the error over time.
/// @param data the record, in the states of the model.
Page sync_page(const SyncReport& report, const Dataset& data);

}  // namespace lacuna
