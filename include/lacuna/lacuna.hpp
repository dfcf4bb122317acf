// SPDX-License-Identifier: MIT
// All that most programs need: records, models, `identify`, `diagnose`, simulation, reports and
// the registry of parts. A pipeline of one's own takes its stages from their own headers.
#pragma once

#include "lacuna/config/configuration.hpp"
#include "lacuna/config/registry.hpp"
#include "lacuna/core/error.hpp"
#include "lacuna/data/read.hpp"
#include "lacuna/data/write.hpp"
#include "lacuna/diagnosis/diagnose.hpp"
#include "lacuna/dynamics/runge_kutta.hpp"
#include "lacuna/dynamics/simulate.hpp"
#include "lacuna/dynamics/synchroniser.hpp"
#include "lacuna/model/model_file.hpp"
#include "lacuna/pipeline/presets.hpp"
#include "lacuna/records/bound_records.hpp"
#include "lacuna/records/embedding.hpp"
#include "lacuna/records/read_records.hpp"
#include "lacuna/report/diagnosis_report.hpp"
#include "lacuna/report/identification_report.hpp"
#include "lacuna/report/sync_report.hpp"
#include "lacuna/systems/measurement.hpp"
