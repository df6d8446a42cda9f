#include "output/image_writer.h"

#include "output/atomic_file.h"

#include <OpenImageIO/filesystem.h>
#include <algorithm>
#include <exception>
#include <stdexcept>

namespace quasilux {

namespace {

/// Lets OpenImageIO write into our temporary file. What it opens itself it writes through a buffer, and it does not
/// report that the disk is full when that is flushed at the end.
class StreamProxy : public OIIO::Filesystem::IOProxy {
public:
    explicit StreamProxy(OutputStream& stream) : IOProxy("", Write), stream_(stream) {}

    const char* proxytype() const override { return "quasilux"; }
    size_t size() const override { return static_cast<size_t>(size_); }

    bool seek(int64_t offset) override {
        if (!succeeds([&] { stream_.seek(offset); })) return false;
        m_pos = offset;
        return true;
    }

    size_t write(const void* data, size_t bytes) override {
        if (!succeeds([&] { stream_.write(data, bytes); })) return 0;
        m_pos += static_cast<int64_t>(bytes);
        size_ = std::max(size_, m_pos);
        return bytes;
    }

    /// What failed, if anything did.
    void rethrow() const {
        if (failure_) std::rethrow_exception(failure_);
    }

private:
    /// Exceptions may not pass through the library.
    template <typename Action>
    bool succeeds(const Action& action) {
        try {
            action();
            return true;
        } catch (...) {
            failure_ = std::current_exception();
            return false;
        }
    }

    OutputStream& stream_;
    int64_t size_ = 0;
    std::exception_ptr failure_;
};

} // namespace

void writeImage(const std::string& path, const std::string& format, const OIIO::ImageSpec& spec,
                const std::function<bool(OIIO::ImageOutput&)>& write) {
    AtomicFile file(path);
    OutputStream stream(file, path);
    StreamProxy proxy(stream);
    const auto output = OIIO::ImageOutput::create(format, &proxy);
    if (!output) throw std::runtime_error("cannot write " + path + ": " + OIIO::geterror());
    const bool isWritten = output->open(file.temporary(), spec) && write(*output) && output->close();
    proxy.rethrow();
    if (!isWritten) throw std::runtime_error("cannot write " + path + ": " + output->geterror());
    stream.close();
    file.commit();
}

} // namespace quasilux
