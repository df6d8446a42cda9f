// Put before libOpenCL by LD_PRELOAD: calls of OpenCL that fail as the environment says, so that tests see what the
// program does then.
//   QUASILUX_FAIL_CALL     clEnqueueNDRangeKernel, clGetEventProfilingInfo or clGetDeviceInfo
//   QUASILUX_FAIL_KERNEL   of the first of these: only launches of this kernel count
//   QUASILUX_FAIL_AT       the call that fails, and all after it, counted from 1
//   QUASILUX_FAIL_AFTER    instead: those from so many seconds on after the first that counts
#include <CL/cl.h>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>

namespace {

using Clock = std::chrono::steady_clock;

const char* variable(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

bool isDue() {
    static std::atomic<long> calls{0};
    static const Clock::time_point first = Clock::now();
    static const long at = std::atol(variable("QUASILUX_FAIL_AT"));
    static const double after = std::atof(variable("QUASILUX_FAIL_AFTER"));
    if (after > 0) return std::chrono::duration<double>(Clock::now() - first).count() >= after;
    return at > 0 && ++calls >= at;
}

bool fails(const char* call) { return std::strcmp(variable("QUASILUX_FAIL_CALL"), call) == 0 && isDue(); }

bool isKernel(cl_kernel kernel) {
    const char* wanted = variable("QUASILUX_FAIL_KERNEL");
    char name[256] = "";
    return *wanted == 0 ||
           (clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, sizeof name, name, nullptr) == CL_SUCCESS &&
            std::strcmp(name, wanted) == 0);
}

template <typename Function>
Function* real(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

} // namespace

extern "C" {

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t* offset,
                              const size_t* global, const size_t* local, cl_uint waits, const cl_event* waitFor,
                              cl_event* event) {
    if (isKernel(kernel) && fails("clEnqueueNDRangeKernel")) return CL_OUT_OF_RESOURCES;
    static auto* call = real<decltype(clEnqueueNDRangeKernel)>("clEnqueueNDRangeKernel");
    return call(queue, kernel, dimensions, offset, global, local, waits, waitFor, event);
}

cl_int clGetEventProfilingInfo(cl_event event, cl_profiling_info name, size_t size, void* value, size_t* returned) {
    if (fails("clGetEventProfilingInfo")) return CL_PROFILING_INFO_NOT_AVAILABLE;
    static auto* call = real<decltype(clGetEventProfilingInfo)>("clGetEventProfilingInfo");
    return call(event, name, size, value, returned);
}

cl_int clGetDeviceInfo(cl_device_id device, cl_device_info name, size_t size, void* value, size_t* returned) {
    if (fails("clGetDeviceInfo")) return CL_OUT_OF_HOST_MEMORY;
    static auto* call = real<decltype(clGetDeviceInfo)>("clGetDeviceInfo");
    return call(device, name, size, value, returned);
}

} // extern "C"
