#include "bench/device_energy.h"

#include <dlfcn.h>
#include <fstream>
#include <vector>

namespace quasilux {

namespace fs = std::filesystem;

struct EnergyCounter::Source {
    virtual ~Source() = default;
    virtual std::optional<double> joules() = 0;
};

namespace {

std::optional<uint64_t> readNumber(const fs::path& file) {
    std::ifstream stream(file);
    uint64_t number = 0;
    if (!(stream >> number)) return std::nullopt; // often for root only
    return number;
}

class Rapl : public EnergyCounter::Source {
public:
    explicit Rapl(const fs::path& powercap) {
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(powercap, none)) {
            const std::string name = entry.path().filename().string();
            // "intel-rapl:0" is a package, "intel-rapl:0:1" a part of it; of AMD's processors too.
            const bool isPackage = name.rfind("intel-rapl:", 0) == 0 && name.find(':', 11) == std::string::npos;
            const auto now = readNumber(entry.path() / "energy_uj");
            const auto range = readNumber(entry.path() / "max_energy_range_uj");
            if (isPackage && now && range) packages_.push_back({entry.path() / "energy_uj", *range, *now});
        }
    }
    std::optional<double> joules() override {
        for (Package& package : packages_) {
            const auto now = readNumber(package.file);
            if (!now) return std::nullopt;
            sum_ += *now >= package.last ? *now - package.last : *now + package.range - package.last;
            package.last = *now;
        }
        return 1e-6 * static_cast<double>(sum_);
    }
    bool isEmpty() const { return packages_.empty(); }

private:
    struct Package {
        fs::path file;
        uint64_t range = 0, last = 0; // microjoules
    };
    std::vector<Package> packages_;
    uint64_t sum_ = 0;
};

/// The library belongs to NVIDIA's driver, so it is looked for when the program runs.
class Nvml : public EnergyCounter::Source {
public:
    explicit Nvml(const std::string& name) : library_(dlopen("libnvidia-ml.so.1", RTLD_NOW | RTLD_LOCAL)) {
        if (!library_) return;
        const auto init = function<int()>("nvmlInit_v2");
        const auto count = function<int(unsigned*)>("nvmlDeviceGetCount_v2");
        const auto handle = function<int(unsigned, void**)>("nvmlDeviceGetHandleByIndex_v2");
        const auto getName = function<int(void*, char*, unsigned)>("nvmlDeviceGetName");
        energy_ = function<int(void*, unsigned long long*)>("nvmlDeviceGetTotalEnergyConsumption");
        unsigned devices = 0;
        if (!init || !count || !handle || !getName || !energy_ || init() != 0 || count(&devices) != 0) return;
        for (unsigned k = 0; k < devices && !device_; ++k) {
            void* candidate = nullptr;
            char text[128] = {};
            if (handle(k, &candidate) == 0 && getName(candidate, text, sizeof text) == 0 && name == text)
                device_ = candidate;
        }
    }
    ~Nvml() override {
        if (library_) dlclose(library_);
    }
    Nvml(const Nvml&) = delete;
    Nvml& operator=(const Nvml&) = delete;

    std::optional<double> joules() override {
        unsigned long long millijoules = 0;
        if (!device_ || energy_(device_, &millijoules) != 0) return std::nullopt;
        return 1e-3 * static_cast<double>(millijoules);
    }

private:
    template <typename Function>
    Function* function(const char* name) {
        return reinterpret_cast<Function*>(dlsym(library_, name));
    }

    void* library_;
    void* device_ = nullptr;
    int (*energy_)(void*, unsigned long long*) = nullptr;
};

} // namespace

EnergyCounter::EnergyCounter(const DeviceInfo& device, const fs::path& powercap) {
    if (device.isCpu) {
        auto rapl = std::make_unique<Rapl>(powercap);
        if (!rapl->isEmpty()) source_ = std::move(rapl);
    } else if (device.platform.find("NVIDIA") != std::string::npos)
        source_ = std::make_unique<Nvml>(device.name);
}

EnergyCounter::~EnergyCounter() = default;
EnergyCounter::EnergyCounter(EnergyCounter&&) noexcept = default;

std::optional<double> EnergyCounter::joules() { return source_ ? source_->joules() : std::nullopt; }

} // namespace quasilux
