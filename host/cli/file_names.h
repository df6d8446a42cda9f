// Names of output files by pattern: {scene}, {sensor}, {date}, {seed}, {passes} stand for what a render knows of
// itself.
#pragma once

#include <map>
#include <string>

namespace quasilux {

/// What is known of a render so far, by the word in braces.
using NameParts = std::map<std::string, std::string>;

/// When a name has to be whole.
enum class NameNeeded { whenWritten, beforeLoading };

/// Throws InputError for words that are not known, or not known in time: {seed} and {passes} come late, and are no part
/// of folders. `option` is named in the message.
void checkNamePattern(const std::string& pattern, const std::string& option, NameNeeded when = NameNeeded::whenWritten);
/// Those that are known take their places, the others stay. A '/' in one becomes '_'.
std::string fillName(std::string pattern, const NameParts& known);
bool hasPlace(const std::string& pattern, const std::string& word);

/// {scene} and {date}.
NameParts namePartsOf(const std::string& scene);
/// {seed} and {passes}.
NameParts namePartsOf(unsigned long long seed, unsigned long long passes);

/// A name without a folder lies in `folder`; others stay, and all where that is empty.
/// Throws InputError where it is needed and does not exist.
std::string inFolder(const std::string& folder, const std::string& name);

} // namespace quasilux
