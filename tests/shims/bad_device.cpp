// Put before libOpenCL by LD_PRELOAD: one of several devices is bad, so that tests see how a render goes on without it.
//   QUASILUX_BAD_QUEUE   the device whose command queue is created as this one, from 1; 0: all
//   QUASILUX_BAD_HOW     lost: its launches of kernels fail; silent: they wait for an hour; nan: what is read from it
//                        in 16 KiB and more, as films are, holds one;
//                        memory: its buffers cannot be created; build: its programs do not build
//   QUASILUX_BAD_AT      of its launches the first that is lost or silent, of its reads the first with a NaN, from 1
//   QUASILUX_BAD_SINCE   instead: those from when this file is there
#include <CL/cl.h>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <limits>
#include <mutex>
#include <unistd.h>
#include <vector>

namespace {

struct Queue {
    cl_command_queue queue;
    cl_context context;
};
std::mutex mutex;
std::vector<Queue> queues; // NOLINT: as they are created

const char* variable(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

bool is(const char* how) { return std::strcmp(variable("QUASILUX_BAD_HOW"), how) == 0; }

bool isBad(size_t index) {
    const auto wanted = static_cast<size_t>(std::atol(variable("QUASILUX_BAD_QUEUE")));
    return wanted == 0 || wanted == index + 1;
}

bool isBadQueue(cl_command_queue queue) {
    const std::scoped_lock lock(mutex);
    for (size_t k = 0; k < queues.size(); ++k)
        if (queues[k].queue == queue) return isBad(k);
    return false;
}

bool isBadContext(cl_context context) {
    const std::scoped_lock lock(mutex);
    for (size_t k = 0; k < queues.size(); ++k)
        if (queues[k].context == context) return isBad(k);
    return false;
}

bool isDue() {
    if (const char* file = variable("QUASILUX_BAD_SINCE"); *file != 0) return access(file, F_OK) == 0;
    static std::atomic<long> calls{0};
    static const long at = std::atol(variable("QUASILUX_BAD_AT"));
    return ++calls >= at;
}

template <typename Function>
Function* real(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

} // namespace

extern "C" {

cl_command_queue clCreateCommandQueue(cl_context context, cl_device_id device, cl_command_queue_properties properties,
                                      cl_int* error) {
    static auto* call = real<decltype(clCreateCommandQueue)>("clCreateCommandQueue");
    cl_command_queue queue = call(context, device, properties, error);
    const std::scoped_lock lock(mutex);
    queues.push_back({queue, context});
    return queue;
}

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t* offset,
                              const size_t* global, const size_t* local, cl_uint waits, const cl_event* waitFor,
                              cl_event* event) {
    if ((is("lost") || is("silent")) && isBadQueue(queue) && isDue()) {
        if (is("lost")) return CL_OUT_OF_RESOURCES;
        sleep(3600);
    }
    static auto* call = real<decltype(clEnqueueNDRangeKernel)>("clEnqueueNDRangeKernel");
    return call(queue, kernel, dimensions, offset, global, local, waits, waitFor, event);
}

cl_int clEnqueueReadBuffer(cl_command_queue queue, cl_mem buffer, cl_bool blocking, size_t offset, size_t size,
                           void* into, cl_uint waits, const cl_event* waitFor, cl_event* event) {
    static auto* call = real<decltype(clEnqueueReadBuffer)>("clEnqueueReadBuffer");
    const cl_int result = call(queue, buffer, blocking, offset, size, into, waits, waitFor, event);
    if (is("nan") && size >= 16384 && isBadQueue(queue) && isDue()) {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        std::memcpy(into, &nan, sizeof nan);
    }
    return result;
}

cl_mem clCreateBuffer(cl_context context, cl_mem_flags flags, size_t size, void* memory, cl_int* error) {
    if (is("memory") && isBadContext(context)) {
        if (error) *error = CL_MEM_OBJECT_ALLOCATION_FAILURE;
        return nullptr;
    }
    static auto* call = real<decltype(clCreateBuffer)>("clCreateBuffer");
    return call(context, flags, size, memory, error);
}

cl_int clBuildProgram(cl_program program, cl_uint count, const cl_device_id* devices, const char* options,
                      void(CL_CALLBACK* notify)(cl_program, void*), void* data) {
    cl_context context = nullptr;
    clGetProgramInfo(program, CL_PROGRAM_CONTEXT, sizeof context, &context, nullptr);
    if (is("build") && isBadContext(context)) return CL_OUT_OF_HOST_MEMORY;
    static auto* call = real<decltype(clBuildProgram)>("clBuildProgram");
    return call(program, count, devices, options, notify, data);
}

} // extern "C"
