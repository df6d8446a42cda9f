// Whether something stands between two places of a scene.
#pragma once

#include "scene/scene.h"

#include <memory>

namespace quasilux {

/// Surfaces of a scene but those that let all light pass (bsdf 'null'). Panes of glass and masks hide what is behind
/// them.
class Occlusion {
public:
    explicit Occlusion(const Scene& scene);
    ~Occlusion();
    Occlusion(const Occlusion&) = delete;
    Occlusion& operator=(const Occlusion&) = delete;

    /// Less the ends, where there may be a surface.
    bool isHidden(const glm::dvec3& from, const glm::dvec3& to) const;

private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

} // namespace quasilux
