// Whether OpenCL is set up on this computer: what its loader finds, and whether a device computes.
#pragma once

#include <string>
#include <vector>

namespace quasilux {

/// By which a runtime says to the loader where it is.
struct VendorFile {
    std::string path, library;
    std::string problem; ///< why the library cannot be loaded; empty: it can
};

/// The folder, or the one file, that the loader reads: OCL_ICD_VENDORS, or else /etc/OpenCL/vendors.
std::string vendorPlace();
/// Of that place; none where it does not exist.
std::vector<VendorFile> vendorFiles();

/// Compiles a small kernel for the device of this number and runs it. Seconds that took. Throws DeviceError, also where
/// the result is wrong.
double runSelfTest(int device);

} // namespace quasilux
