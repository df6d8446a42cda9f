// Help with misspelt names: the nearest known one, and the list of all.
#pragma once

#include <string>
#include <vector>

namespace quasilux {

/// The known name with the fewest edits to `word`; empty if even that one differs in more than a third of its letters.
std::string nearestName(const std::string& word, const std::vector<std::string>& known);

/// "expected a, b or c", and ", did you mean 'b'?" where a name is near.
std::string expectedNames(const std::string& word, const std::vector<std::string>& known);

} // namespace quasilux
