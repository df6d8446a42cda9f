// A tree on the device and the kernels of kernels/micro/traversal.cl, as they are or with mistakes put in.
#pragma once

#include "support/test_kernels.h"
#include "support/traversal_rays.h"

#include <map>

namespace quasilux {

/// Kernel files to use instead of the real ones.
using KernelSources = std::map<std::string, std::string>;

/// Builds tests/kernels/`file` with these.
Program mutantProgram(const std::string& file, const std::string& options, KernelSources replaced);

/// The kernel file with `from` replaced; the text must be there.
KernelSources mutant(const std::string& file, const std::string& from, const std::string& to);

class TraversalDevice {
public:
    explicit TraversalDevice(const std::vector<BvhPrimitive>& primitives, const std::string& options = "",
                             const KernelSources& replaced = {});

    const Bvh& bvh() const { return bvh_; }
    std::vector<TestHit> closest(const Rays& rays) { return run<TestHit>("closestHits", rays); }
    std::vector<TestHit> closestOpaque(const Rays& rays) { return run<TestHit>("closestOpaqueHits", rays); }
    std::vector<unsigned> occluded(const Rays& rays) { return run<unsigned>("occlusion", rays); }
    /// Both again in packets of sixteen neighbours. The number of rays must be a multiple of 16.
    std::vector<TestHit> closestOfPackets(const Rays& rays);
    std::vector<unsigned> occludedOfPackets(const Rays& rays);

    /// One launch over rays, or packets of them, that are on the device already.
    template <typename Sent, typename Answer>
    void launch(const std::string& kernel, const Buffer<Sent>& rays, const Buffer<Answer>& answers) {
        program_.kernel(kernel).launch(rays.size(), nodes_, blocks_, rays, answers, cl_uint(rays.size()));
        testDevice().finish();
    }

private:
    template <typename Answer, typename Sent>
    std::vector<Answer> run(const std::string& kernel, const std::vector<Sent>& rays, size_t perItem = 1) {
        Buffer<Sent> in(testDevice(), rays, "rays");
        Buffer<Answer> out(testDevice(), perItem * rays.size(), "answers");
        launch(kernel, in, out);
        return out.read();
    }

    Bvh bvh_;
    Buffer<shared::BvhNode> nodes_;
    Buffer<shared::PrimitiveBlock> blocks_;
    Program program_;
};

} // namespace quasilux
