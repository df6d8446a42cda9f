// What ranks say to each other, as the heads of messages.
#pragma once

#include "ranks/job.h"
#include "ranks/mpi/messages.h"

namespace quasilux {

nlohmann::json toJson(const RankPlan& plan); ///< but for what was learned
RankPlan planOf(const nlohmann::json& json);

Message toMessage(const WorkerEvent& event);
/// Its worker has the number that it has on its own rank.
WorkerEvent eventOf(const Message& message);

/// Sums but for the film.
nlohmann::json toJson(const PassSums& sums);
PassSums sumsOf(const nlohmann::json& json);

} // namespace quasilux
