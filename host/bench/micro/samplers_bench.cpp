#include "bench/micro/parts.h"
namespace quasilux {
void benchSamplers(const MicroRun& run) { run.progress("samplers"); }
} // namespace quasilux
