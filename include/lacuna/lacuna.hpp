// SPDX-License-Identifier: MIT
// All that most programs need: records, models, `identify`, `diagnose`, simulation, reports and
// the registry of parts. A pipeline of one's own takes its stages from their own headers.
#pragma once

#include "lacuna/cli/configuration/configuration.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/read.hpp"
#include "lacuna/data/formats/write.hpp"
#include "lacuna/diagnose/journey/diagnose.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/integration/synchroniser.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/identify/journey/identify_records.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/bound_records.hpp"
#include "lacuna/records/binding/embedding.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "lacuna/report/pages/diagnosis_report.hpp"
#include "lacuna/report/pages/identification_report.hpp"
#include "lacuna/report/pages/sync_report.hpp"
