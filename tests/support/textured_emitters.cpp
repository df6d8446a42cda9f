#include "support/textured_emitters.h"

#include "prepare/device_scene.h"
#include "support/test_kernels.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

namespace quasilux {

namespace {

using glm::dvec3;

Program& program() {
    static Program built =
        testProgram("textured_emitters.cl", "-DHAS_EMITTER_SPOT -DHAS_EMITTER_PROJECTOR -DHAS_EMITTER_TEXTURES");
    return built;
}

dvec3 tripleAt(const std::vector<float>& values, size_t first) {
    return {values[first], values[first + 1], values[first + 2]};
}

/// Launches `kernel` over `count` items of `in`, with `words` of result each.
std::vector<float> launch(const char* kernel, const TexturedEmitter& emitter, const std::vector<float>& in,
                          size_t count, size_t words) {
    Device& device = testDevice();
    Buffer<shared::Emitter> record(device, {emitter.record}, "emitter");
    Buffer<shared::Texture> texture(device, {emitter.texture}, "texture");
    Buffer<Rgb> texels(device, emitter.texels.empty() ? std::vector<Rgb>(1) : emitter.texels, "texels");
    Buffer<float> given(device, in, "given"), out(device, words * count, "result");
    program().kernel(kernel).launch(count, record, texture, texels, given, out, cl_uint(count));
    return out.read();
}

} // namespace

TexturedEmitter lastEmitter(const Scene& scene) {
    const FlattenSettings settings{"auto", 1000, false};
    const DeviceScene flat = flattenScene(scene, settings);
    TexturedEmitter emitter;
    emitter.record = flat.emitters.emitters.back();
    emitter.power = flat.emitters.power.back();
    if (emitter.record.texture == 0) return emitter;
    const TextureDescription& texture = scene.textures.at(emitter.record.texture - 1);
    emitter.texture = texture.device;
    emitter.texels = texture.texels;
    emitter.record.texture = 1;
    return emitter;
}

dvec3 askew(const dvec3& local) {
    const dvec3 z = glm::normalize(dvec3(1, 2, 1)), x = glm::normalize(glm::cross(dvec3(0, 0, 1), z));
    return glm::normalize(local.x * x + local.y * glm::cross(z, x) + local.z * z);
}

std::vector<dvec3> intensities(const TexturedEmitter& emitter, const std::vector<dvec3>& directions) {
    std::vector<float> in;
    for (const dvec3& d : directions) in.insert(in.end(), {float(d.x), float(d.y), float(d.z)});
    const auto values = launch("intensities", emitter, in, directions.size(), 3);
    std::vector<dvec3> result;
    for (size_t i = 0; i < directions.size(); ++i) result.push_back(tripleAt(values, 3 * i));
    return result;
}

std::vector<DirectedPhoton> directedPhotons(const TexturedEmitter& emitter, const std::vector<float>& numbers) {
    const size_t count = numbers.size() / 2;
    const auto values = launch("photons", emitter, numbers, count, 8);
    std::vector<DirectedPhoton> result;
    for (size_t i = 0; i < count; ++i)
        result.push_back(
            {tripleAt(values, 8 * i), tripleAt(values, 8 * i + 3), {values[8 * i + 6], values[8 * i + 7]}});
    return result;
}

void writeFloats(const std::string& path, int width, int height, const std::vector<float>& rgb) {
    const auto file = OIIO::ImageOutput::create(path);
    ASSERT_TRUE(file && file->open(path, OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::FLOAT))) << path;
    ASSERT_TRUE(file->write_image(OIIO::TypeDesc::FLOAT, rgb.data()) && file->close()) << path;
}

void writeSixPixels(const std::string& path) {
    std::vector<float> pixels;
    for (int k = 0; k < 6; ++k) pixels.insert(pixels.end(), {0.1f * float(k), 0.5f * float(k), 2 - 0.3f * float(k)});
    writeFloats(path, 3, 2, pixels);
}

} // namespace quasilux
