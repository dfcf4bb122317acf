// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/diagnose/diagnosis.hpp"
#include "lacuna/identify/bench/bench.hpp"
#include "lacuna/report/reports.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "report/pages/page.hpp"

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

/// A fit as a page: numbers with intervals, what is not determined, records beside free runs.
Page fit_page(const Fit& fit);

/// A comparison of parts as a page: a heat map of compositions by noise, all numbers, failures.
/// @param subject what they were compared on: a file or a system.
Page bench_page(const BenchResult& result, const std::string& subject);

}  // namespace lacuna
