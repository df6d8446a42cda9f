// Put before the libraries by LD_PRELOAD: one call of OpenCL, of a file of the working folder, or of operator new
// fails, so that tests see what the program does then. Without an order every call is counted and passed on.
//   QUASILUX_FAIL_CALL    name of the function, as in `calls` below
//   QUASILUX_FAIL_AT      which of its calls fails, counted from 1; those after it succeed again. -1: all
//   QUASILUX_NO_LINKS     if set: the file system knows no second names
//   QUASILUX_COUNT_CALLS  file that gets the calls of each function, "NAME NUMBER", when the program ends
#include <CL/cl.h>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <link.h>
#include <new>
#include <stdio_ext.h>
#include <unistd.h>

namespace {

constexpr const char* calls[] = {"clGetPlatformIDs",
                                 "clGetPlatformInfo",
                                 "clGetDeviceIDs",
                                 "clGetDeviceInfo",
                                 "clCreateSubDevices",
                                 "clCreateContext",
                                 "clCreateCommandQueue",
                                 "clCreateBuffer",
                                 "clSetMemObjectDestructorCallback",
                                 "clCreateProgramWithSource",
                                 "clBuildProgram",
                                 "clGetProgramBuildInfo",
                                 "clGetProgramInfo",
                                 "clCreateKernel",
                                 "clSetKernelArg",
                                 "clGetKernelWorkGroupInfo",
                                 "clEnqueueNDRangeKernel",
                                 "clEnqueueReadBuffer",
                                 "clEnqueueWriteBuffer",
                                 "clEnqueueFillBuffer",
                                 "clEnqueueCopyBuffer",
                                 "clFlush",
                                 "clFinish",
                                 "clWaitForEvents",
                                 "clGetEventInfo",
                                 "clGetEventProfilingInfo",
                                 "clRetainContext",
                                 "clRetainCommandQueue",
                                 "clRetainDevice",
                                 "clRetainEvent",
                                 "clRetainKernel",
                                 "clRetainMemObject",
                                 "clRetainProgram",
                                 "clReleaseContext",
                                 "clReleaseCommandQueue",
                                 "clReleaseDevice",
                                 "clReleaseEvent",
                                 "clReleaseKernel",
                                 "clReleaseMemObject",
                                 "clReleaseProgram",
                                 "open",
                                 "fopen",
                                 "read",
                                 "fread",
                                 "write",
                                 "fwrite",
                                 "ftruncate",
                                 "fsync",
                                 "close",
                                 "fclose",
                                 "link",
                                 "rename",
                                 "new"};
constexpr size_t callCount = sizeof calls / sizeof *calls;

std::atomic<long> counts[callCount];

constexpr size_t indexOf(const char* name) {
    for (size_t k = 0; k < callCount; ++k) {
        const char *a = calls[k], *b = name;
        while (*a != 0 && *a == *b) ++a, ++b;
        if (*a == *b) return k;
    }
    return callCount;
}

const char* variable(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

struct Order {
    size_t index = indexOf(variable("QUASILUX_FAIL_CALL"));
    long at = std::atol(variable("QUASILUX_FAIL_AT"));
};

/// Counts a call, and says whether it is to fail.
bool fails(size_t index) {
    static const Order order;
    const long now = ++counts[index];
    return index == order.index && (now == order.at || order.at < 0);
}

template <typename Function>
Function* real(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

// --- files ---

bool isOurs(const char* path) {
    if (path == nullptr) return false;
    if (*path != '/') return true;
    static char folder[PATH_MAX];
    static const size_t length = getcwd(folder, sizeof folder) ? std::strlen(folder) : 0;
    return length > 1 && std::strncmp(path, folder, length) == 0 && path[length] == '/';
}

bool isOurs(int descriptor) {
    char name[64], path[PATH_MAX];
    std::snprintf(name, sizeof name, "/proc/self/fd/%d", descriptor);
    const ssize_t length = readlink(name, path, sizeof path - 1);
    if (length <= 0 || path[0] != '/') return false;
    path[length] = 0;
    return isOurs(path);
}

int failWith(int why) {
    errno = why;
    return -1;
}

// --- memory ---

/// The executable memory of the program itself: what libraries allocate is none of its business.
struct ProgramCode {
    uintptr_t begin = 0, end = 0;
    ProgramCode() {
        dl_iterate_phdr(
            [](dl_phdr_info* info, size_t, void* into) {
                auto* code = static_cast<ProgramCode*>(into);
                for (int k = 0; k < info->dlpi_phnum; ++k) {
                    const auto& part = info->dlpi_phdr[k];
                    if (part.p_type != PT_LOAD || (part.p_flags & PF_X) == 0) continue;
                    code->begin = info->dlpi_addr + part.p_vaddr;
                    code->end = code->begin + part.p_memsz;
                }
                return 1; // the first one is the program
            },
            this);
    }
    bool holds(const void* address) const {
        const auto at = reinterpret_cast<uintptr_t>(address);
        return at >= begin && at < end;
    }
};

// Before, libraries make their globals, whose strings may take functions of the program's: nobody can catch what fails.
std::atomic<bool> isMainRunning = false;
int (*mainOfProgram)(int, char**, char**) = nullptr;
int runMain(int argc, char** argv, char** environment) {
    isMainRunning = true;
    return mainOfProgram(argc, argv, environment);
}

void* allocate(size_t bytes, size_t alignment, const void* caller) {
    static const ProgramCode code;
    if (isMainRunning && code.holds(caller) && fails(indexOf("new"))) throw std::bad_alloc();
    void* const memory = alignment > 0 ? std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment)
                                       : std::malloc(bytes > 0 ? bytes : 1);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

struct CountWriter {
    ~CountWriter() {
        const char* path = variable("QUASILUX_COUNT_CALLS");
        if (*path == 0) return;
        FILE* file = real<decltype(fopen)>("fopen")(path, "w");
        if (file == nullptr) return;
        for (size_t k = 0; k < callCount; ++k) std::fprintf(file, "%s %ld\n", calls[k], counts[k].load());
        real<decltype(fclose)>("fclose")(file);
    }
} countWriter;

} // namespace

void* operator new(size_t bytes) { return allocate(bytes, 0, __builtin_return_address(0)); }
void* operator new[](size_t bytes) { return allocate(bytes, 0, __builtin_return_address(0)); }
void* operator new(size_t bytes, std::align_val_t alignment) {
    return allocate(bytes, static_cast<size_t>(alignment), __builtin_return_address(0));
}
void* operator new[](size_t bytes, std::align_val_t alignment) {
    return allocate(bytes, static_cast<size_t>(alignment), __builtin_return_address(0));
}

extern "C" {

int __libc_start_main(int (*main)(int, char**, char**), int argc, char** argv, void (*init)(), void (*end)(),
                      void (*endOfLoader)(), void* stackEnd) {
    mainOfProgram = main;
    static auto* call = real<decltype(__libc_start_main)>("__libc_start_main");
    return call(runMain, argc, argv, init, end, endOfLoader, stackEnd);
}

#define STATUS_CALL(name, error, parameters, arguments)                                                                \
    cl_int name parameters {                                                                                           \
        if (fails(indexOf(#name))) return error;                                                                       \
        static auto* call = real<decltype(name)>(#name);                                                               \
        return call arguments;                                                                                         \
    }
#define OBJECT_CALL(type, name, error, parameters, arguments)                                                          \
    type name parameters {                                                                                             \
        if (fails(indexOf(#name))) {                                                                                   \
            if (status) *status = error;                                                                               \
            return nullptr;                                                                                            \
        }                                                                                                              \
        static auto* call = real<decltype(name)>(#name);                                                               \
        return call arguments;                                                                                         \
    }
#define REFERENCE_CALLS(kind, type)                                                                                    \
    STATUS_CALL(clRetain##kind, CL_OUT_OF_HOST_MEMORY, (type object), (object))                                        \
    STATUS_CALL(clRelease##kind, CL_OUT_OF_HOST_MEMORY, (type object), (object))

STATUS_CALL(clGetPlatformIDs, CL_OUT_OF_HOST_MEMORY, (cl_uint count, cl_platform_id* ids, cl_uint* found),
            (count, ids, found))
STATUS_CALL(clGetPlatformInfo, CL_OUT_OF_HOST_MEMORY,
            (cl_platform_id platform, cl_platform_info what, size_t size, void* value, size_t* found),
            (platform, what, size, value, found))
STATUS_CALL(clGetDeviceIDs, CL_OUT_OF_HOST_MEMORY,
            (cl_platform_id platform, cl_device_type type, cl_uint count, cl_device_id* ids, cl_uint* found),
            (platform, type, count, ids, found))
STATUS_CALL(clGetDeviceInfo, CL_OUT_OF_HOST_MEMORY,
            (cl_device_id device, cl_device_info what, size_t size, void* value, size_t* found),
            (device, what, size, value, found))
STATUS_CALL(clCreateSubDevices, CL_DEVICE_PARTITION_FAILED,
            (cl_device_id device, const cl_device_partition_property* how, cl_uint count, cl_device_id* ids,
             cl_uint* found),
            (device, how, count, ids, found))
OBJECT_CALL(cl_context, clCreateContext, CL_DEVICE_NOT_AVAILABLE,
            (const cl_context_properties* how, cl_uint count, const cl_device_id* devices,
             void(CL_CALLBACK* notify)(const char*, const void*, size_t, void*), void* user, cl_int* status),
            (how, count, devices, notify, user, status))
OBJECT_CALL(cl_command_queue, clCreateCommandQueue, CL_OUT_OF_RESOURCES,
            (cl_context context, cl_device_id device, cl_command_queue_properties how, cl_int* status),
            (context, device, how, status))
OBJECT_CALL(cl_mem, clCreateBuffer, CL_MEM_OBJECT_ALLOCATION_FAILURE,
            (cl_context context, cl_mem_flags flags, size_t size, void* memory, cl_int* status),
            (context, flags, size, memory, status))
STATUS_CALL(clSetMemObjectDestructorCallback, CL_OUT_OF_HOST_MEMORY,
            (cl_mem memory, void(CL_CALLBACK* notify)(cl_mem, void*), void* user), (memory, notify, user))
OBJECT_CALL(cl_program, clCreateProgramWithSource, CL_OUT_OF_HOST_MEMORY,
            (cl_context context, cl_uint count, const char** texts, const size_t* lengths, cl_int* status),
            (context, count, texts, lengths, status))
STATUS_CALL(clBuildProgram, CL_BUILD_PROGRAM_FAILURE,
            (cl_program program, cl_uint count, const cl_device_id* devices, const char* options,
             void(CL_CALLBACK* notify)(cl_program, void*), void* user),
            (program, count, devices, options, notify, user))
STATUS_CALL(clGetProgramBuildInfo, CL_OUT_OF_HOST_MEMORY,
            (cl_program program, cl_device_id device, cl_program_build_info what, size_t size, void* value,
             size_t* found),
            (program, device, what, size, value, found))
STATUS_CALL(clGetProgramInfo, CL_OUT_OF_HOST_MEMORY,
            (cl_program program, cl_program_info what, size_t size, void* value, size_t* found),
            (program, what, size, value, found))
OBJECT_CALL(cl_kernel, clCreateKernel, CL_OUT_OF_RESOURCES, (cl_program program, const char* name, cl_int* status),
            (program, name, status))
STATUS_CALL(clSetKernelArg, CL_OUT_OF_RESOURCES, (cl_kernel kernel, cl_uint index, size_t size, const void* value),
            (kernel, index, size, value))
STATUS_CALL(clGetKernelWorkGroupInfo, CL_OUT_OF_RESOURCES,
            (cl_kernel kernel, cl_device_id device, cl_kernel_work_group_info what, size_t size, void* value,
             size_t* found),
            (kernel, device, what, size, value, found))
STATUS_CALL(clEnqueueNDRangeKernel, CL_OUT_OF_RESOURCES,
            (cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t* offset, const size_t* global,
             const size_t* local, cl_uint waits, const cl_event* waitFor, cl_event* event),
            (queue, kernel, dimensions, offset, global, local, waits, waitFor, event))
STATUS_CALL(clEnqueueReadBuffer, CL_OUT_OF_RESOURCES,
            (cl_command_queue queue, cl_mem memory, cl_bool blocking, size_t offset, size_t size, void* into,
             cl_uint waits, const cl_event* waitFor, cl_event* event),
            (queue, memory, blocking, offset, size, into, waits, waitFor, event))
STATUS_CALL(clEnqueueWriteBuffer, CL_OUT_OF_RESOURCES,
            (cl_command_queue queue, cl_mem memory, cl_bool blocking, size_t offset, size_t size, const void* from,
             cl_uint waits, const cl_event* waitFor, cl_event* event),
            (queue, memory, blocking, offset, size, from, waits, waitFor, event))
STATUS_CALL(clEnqueueFillBuffer, CL_OUT_OF_RESOURCES,
            (cl_command_queue queue, cl_mem memory, const void* pattern, size_t patternSize, size_t offset, size_t size,
             cl_uint waits, const cl_event* waitFor, cl_event* event),
            (queue, memory, pattern, patternSize, offset, size, waits, waitFor, event))
STATUS_CALL(clEnqueueCopyBuffer, CL_OUT_OF_RESOURCES,
            (cl_command_queue queue, cl_mem from, cl_mem to, size_t fromOffset, size_t toOffset, size_t size,
             cl_uint waits, const cl_event* waitFor, cl_event* event),
            (queue, from, to, fromOffset, toOffset, size, waits, waitFor, event))
STATUS_CALL(clFlush, CL_OUT_OF_RESOURCES, (cl_command_queue queue), (queue))
STATUS_CALL(clFinish, CL_OUT_OF_RESOURCES, (cl_command_queue queue), (queue))
STATUS_CALL(clWaitForEvents, CL_OUT_OF_RESOURCES, (cl_uint count, const cl_event* events), (count, events))
STATUS_CALL(clGetEventInfo, CL_OUT_OF_HOST_MEMORY,
            (cl_event event, cl_event_info what, size_t size, void* value, size_t* found),
            (event, what, size, value, found))
STATUS_CALL(clGetEventProfilingInfo, CL_PROFILING_INFO_NOT_AVAILABLE,
            (cl_event event, cl_profiling_info what, size_t size, void* value, size_t* found),
            (event, what, size, value, found))
REFERENCE_CALLS(Context, cl_context)
REFERENCE_CALLS(CommandQueue, cl_command_queue)
REFERENCE_CALLS(Device, cl_device_id)
REFERENCE_CALLS(Event, cl_event)
REFERENCE_CALLS(Kernel, cl_kernel)
REFERENCE_CALLS(MemObject, cl_mem)
REFERENCE_CALLS(Program, cl_program)

int open(const char* path, int flags, ...) {
    va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    if (isOurs(path) && fails(indexOf("open"))) return failWith(EMFILE);
    return real<int(const char*, int, ...)>("open")(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
    va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    return open(path, flags, mode);
}

FILE* fopen(const char* path, const char* mode) {
    if (isOurs(path) && fails(indexOf("fopen"))) {
        errno = EMFILE;
        return nullptr;
    }
    return real<decltype(fopen)>("fopen")(path, mode);
}

FILE* fopen64(const char* path, const char* mode) { return fopen(path, mode); }

ssize_t read(int descriptor, void* into, size_t bytes) {
    if (isOurs(descriptor) && fails(indexOf("read"))) return failWith(EIO);
    static auto* call = real<decltype(read)>("read");
    return call(descriptor, into, bytes);
}

// As a disk with a bad block: ferror() knows.
size_t fread(void* into, size_t size, size_t count, FILE* file) {
    static auto* call = real<decltype(fread)>("fread");
    if (!isOurs(fileno(file)) || !fails(indexOf("fread"))) return call(into, size, count, file);
    file->_flags |= 0x20; // _IO_ERR_SEEN of glibc
    errno = EIO;
    return 0;
}

ssize_t write(int descriptor, const void* from, size_t bytes) {
    if (isOurs(descriptor) && fails(indexOf("write"))) return failWith(ENOSPC);
    static auto* call = real<decltype(write)>("write");
    return call(descriptor, from, bytes);
}

size_t fwrite(const void* from, size_t size, size_t count, FILE* file) {
    if (isOurs(fileno(file)) && fails(indexOf("fwrite"))) {
        errno = ENOSPC;
        return 0;
    }
    static auto* call = real<decltype(fwrite)>("fwrite");
    return call(from, size, count, file);
}

int ftruncate(int descriptor, off_t length) {
    if (isOurs(descriptor) && fails(indexOf("ftruncate"))) return failWith(EIO);
    return real<decltype(ftruncate)>("ftruncate")(descriptor, length);
}

int fsync(int descriptor) {
    if (isOurs(descriptor) && fails(indexOf("fsync"))) return failWith(EIO);
    return real<decltype(fsync)>("fsync")(descriptor);
}

int close(int descriptor) {
    static auto* call = real<decltype(close)>("close");
    if (!isOurs(descriptor) || !fails(indexOf("close"))) return call(descriptor);
    call(descriptor); // it is closed all the same
    return failWith(EIO);
}

// What is still in the program's buffer is lost, as on a disk that is full.
int fclose(FILE* file) {
    static auto* call = real<decltype(fclose)>("fclose");
    if (!isOurs(fileno(file)) || !fails(indexOf("fclose"))) return call(file);
    __fpurge(file);
    call(file);
    errno = ENOSPC;
    return EOF;
}

int link(const char* from, const char* to) {
    if (isOurs(to) && (fails(indexOf("link")) || *variable("QUASILUX_NO_LINKS") != 0)) return failWith(EPERM);
    return real<decltype(link)>("link")(from, to);
}

int rename(const char* from, const char* to) {
    if (isOurs(to) && fails(indexOf("rename"))) return failWith(EIO);
    return real<decltype(rename)>("rename")(from, to);
}

} // extern "C"
