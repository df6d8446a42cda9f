// Readers of files as functions of bytes: for libFuzzer (scripts/fuzz.sh), and for the test that reads the seeds.
#pragma once

#include "util/error.h"

#include <map>
#include <string>
#include <string_view>

namespace quasilux::fuzz {

/// Bad input is to end with an InputError; what else `read` throws is passed on.
template <typename Read>
void expectInputErrors(const Read& read) {
    try {
        read();
    } catch (const InputError&) {
    }
}

/// Reads `input`. Bad input throws InputError; whatever else is thrown is a finding.
using Target = void (*)(std::string_view input);

void readXml(std::string_view input);
void readGltf(std::string_view input);
void readObjFile(std::string_view input);
void readPlyFile(std::string_view input);
void readSerializedFile(std::string_view input);
void readCurveFile(std::string_view input);
void readVol(std::string_view input);
void readSpectrum(std::string_view input);
void readIesFile(std::string_view input);
void readEulumdatFile(std::string_view input);
void readWeather(std::string_view input);
void readImageFile(std::string_view input);
void readGrid(std::string_view input);
void readCheckpoint(std::string_view input);
void readEdits(std::string_view input);

/// By the name of the folder of their seeds.
inline const std::map<std::string, Target> targets{{"xml", readXml},
                                                   {"gltf", readGltf},
                                                   {"obj", readObjFile},
                                                   {"ply", readPlyFile},
                                                   {"serialized", readSerializedFile},
                                                   {"curve", readCurveFile},
                                                   {"vol", readVol},
                                                   {"spectrum", readSpectrum},
                                                   {"ies", readIesFile},
                                                   {"eulumdat", readEulumdatFile},
                                                   {"weather", readWeather},
                                                   {"image", readImageFile},
                                                   {"grid", readGrid},
                                                   {"checkpoint", readCheckpoint},
                                                   {"edits", readEdits}};

} // namespace quasilux::fuzz
