// What a scene needs of the kernels: only that is compiled, stored and allocated.
#pragma once

#include "scene/scene.h"

#include <set>
#include <string>
#include <vector>

namespace quasilux {

struct Features {
    std::set<unsigned> lobes;        ///< LOBE_* in use
    std::set<unsigned> emitterTypes; ///< EMITTER_* in use
    std::set<unsigned> phases;       ///< PHASE_* in use
    bool spheres = false, nullPrimitives = false, cornerNormals = false, borders = false, depthLimit = false,
         orthographicCamera = false, textures = false, nestedTextures = false, meshAttributes = false,
         lobeWeights = false, weightFunctions = false, manyLobes = false, relief = false, anisotropy = false,
         alphaTextures = false, indexTextures = false, textureVolumes = false, thinLens = false, fisheyeCamera = false,
         instances = false,
         filterTable = false;                            ///< a reconstruction filter wider than a pixel
    bool sharedFilter = false;                           ///< which leaves less noise where pixels share samples
    bool lowCoats = false;                               ///< rough coats of an index below that outside
    bool radianceMeter = false, irradianceMeter = false; ///< what the sensor is, if no camera
    bool media = false, chromaticMedia = false;          ///< extinction differs between the channels of some medium
    bool heterogeneousMedia = false;                     ///< extinction or albedo of some medium varies in space
    bool directInMedia = false;                          ///< emitter sampling can reach points in some medium
    bool sharingLambert = false, sharingMedia = false;   ///< scattering that shares direct light (direct_sharing.h)
    bool lightTree = false;                              ///< direct light is sampled from many emitters (light_tree.h)
    bool emitterTextures = false;                        ///< what some emitter sends is multiplied by a texture
    bool areaTextures = false;                           ///< and it is a shape
    bool hiddenEmitters = false;                         ///< from the camera
    bool countedPassages = false; ///< what passes straight through a surface begins a segment, and segments are counted
    bool hiddenBeyondPassages = false; ///< emitters, as Scene::hidesBeyondPassages has it
    bool directByPhotons = false; ///< direct light of some emitters is taken from photons (host/learn/direct_choice.h)
    bool genuineDiffuse = false, quasiSpecular = false, specular = false; ///< kinds of scattering of surfaces
    bool genuineDiffuseMedia = false, quasiSpecularMedia = false;         ///< and of media

    /// Compiler options, such as "-DHAS_LOBE_PHONG -DHAS_BORDERS".
    std::string options() const;
    /// For people, such as "lobe phong".
    std::vector<std::string> names() const;
    /// Everything that the kernels know, used or not.
    static Features generic();
    /// What kernels can do for scenes with these features, too. Hidden emitters, counted passages and meters are no
    /// abilities, but other images, and stay as they are here.
    Features with(const Features& further) const;
};

std::string lobeName(unsigned type);
std::string emitterTypeName(unsigned type);

} // namespace quasilux
