// A small scene that photons serve: a diffuse plate and a diffuse sphere, lit by a sphere.
#pragma once

#include <string>

namespace quasilux::test {

/// `film`: pixels of a side; `reflectance` of the plate.
inline std::string litPlate(unsigned film = 4, const std::string& reflectance = "0.5") {
    const std::string side = std::to_string(film);
    return R"(<scene version="3.0.0">
  <sensor type="perspective">
    <float name="fov" value="40"/>
    <film type="hdrfilm"><integer name="width" value=")" +
           side + R"("/><integer name="height" value=")" + side + R"("/></film>
  </sensor>
  <shape type="rectangle"><transform name="to_world"><rotate y="1" angle="180"/><translate z="4"/></transform>
    <bsdf type="diffuse"><rgb name="reflectance" value=")" +
           reflectance + R"("/></bsdf></shape>
  <shape type="sphere"><point name="center" x="0" y="2" z="2"/><float name="radius" value="0.5"/>
    <emitter type="area"><rgb name="radiance" value="1"/></emitter></shape>
  <shape type="sphere"><point name="center" x="2" y="0" z="3"/></shape>
</scene>
)";
}

} // namespace quasilux::test
