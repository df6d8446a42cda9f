// What a sample and an evaluation of every lobe, emitter and phase function cost.
#include "bench/micro/contest.h"
#include "bench/micro/micro_parts.h"
#include "bench/micro/sampler_subjects.h"
#include "device/program.h"

namespace quasilux {

namespace {

constexpr size_t samplesPerItem = 16; // SAMPLES_PER_ITEM of kernels/micro/numbers.clh

/// Times kernels of one program; each sums its samples, item by item, into a buffer that comes last.
class SamplerTimer {
public:
    SamplerTimer(const MicroRun& run, Device& device, unsigned threads)
        : run_(run), device_(device), threads_(threads), sums_(device, run.settings.samples / samplesPerItem, "sums") {}

    template <typename... Buffers>
    void add(Program& program, const std::string& figure, const std::string& kernelName, const Buffers&... buffers) {
        auto kernel = std::make_shared<Kernel>(program.kernel(kernelName));
        ways_.push_back({figure, [this, kernel, &buffers...] {
                             kernel->launch(sums_.size(), buffers..., sums_, cl_uint(sums_.size()));
                             device_.finish();
                         }});
    }

    /// Appends a row with what was added.
    void report(const std::string& name) {
        timeInTurns(ways_, run_.settings.rounds, device_.info());
        MicroRow row{"samplers", name, threads_, "ns", {}, {}};
        for (const TimedWay& way : ways_)
            row.values.emplace_back(way.name, 1e9 * way.seconds / double(sums_.size() * samplesPerItem));
        run_.report.rows.push_back(row);
        ways_.clear();
    }

private:
    const MicroRun& run_;
    Device& device_;
    unsigned threads_;
    Buffer<float> sums_;
    std::vector<TimedWay> ways_;
};

} // namespace

void benchSamplers(const MicroRun& run) {
    const unsigned threads = run.threads.back();
    Device device(run.settings.device, 64, 0, threads);
    SamplerTimer timer(run, device, threads);
    bool first = true;
    for (const auto& subject : lobeSubjects()) {
        if (run.interrupted) return;
        run.progress("samplers: " + subject.name);
        Program program(device, "micro/lobe_samplers.cl", subject.options);
        if (first) {
            timer.add(program, "sample", "drawNumbers");
            timer.report("three numbers alone");
            first = false;
        }
        const Buffer<shared::Lobe> lobe(device, {subject.value}, "lobe");
        timer.add(program, "sample", "sampleLobes", lobe);
        if (subject.hasValues) timer.add(program, "evaluate", "evaluateLobes", lobe);
        timer.report(subject.name);
    }
    const Buffer<shared::EmitterTriangle> triangles(device, {emitterTriangle()}, "triangles");
    for (const auto& subject : emitterSubjects()) {
        if (run.interrupted) return;
        run.progress("samplers: " + subject.name);
        Program program(device, "micro/emitter_samplers.cl", subject.options);
        const Buffer<shared::Emitter> emitter(device, {subject.value}, "emitter");
        const Buffer<uint32_t> tables(device, emitterTables(subject.value.type), "tables");
        timer.add(program, "sample", "sampleEmission", emitter, triangles, tables);
        timer.add(program, "sample direction", "sampleDirection", emitter, triangles, tables);
        timer.report(subject.name);
    }
    for (const auto& subject : phaseSubjects()) {
        if (run.interrupted) return;
        run.progress("samplers: " + subject.name);
        Program program(device, "micro/phase_samplers.cl", subject.options);
        const Buffer<shared::Medium> medium(device, {subject.value}, "medium");
        timer.add(program, "sample", "samplePhase", medium);
        timer.add(program, "evaluate", "evaluatePhase", medium);
        timer.report(subject.name);
    }
}

} // namespace quasilux
