/* Rays of kernels/camera.clh. */
#include "camera.clh"

/* Origin (3), direction (3), tMin, tMax of the ray through each pixel in pass `pass`. */
__kernel void cameraRays(const Camera camera, const uint pass, __global float* result) {
    const uint pixel = get_global_id(0);
    if (pixel >= camera.width * camera.height) return;
    const FilterPlace place = filterPlace(&camera, 0, pixel, pixelPlace(pixel, pass, 7));
    const Ray ray = cameraRay(&camera, pixel, place.offset, lensNumbers(pixel, pass, 7));
    vstore3(ray.origin, 0, result + 8 * pixel);
    vstore3(ray.direction, 0, result + 8 * pixel + 3);
    result[8 * pixel + 6] = ray.tMin;
    result[8 * pixel + 7] = ray.tMax;
}
