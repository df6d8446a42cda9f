// The files of one result, each written whether or not others can be.
#pragma once

#include <exception>
#include <functional>
#include <string>
#include <vector>

namespace quasilux {

class WrittenFiles {
public:
    /// Nothing where `path` is empty.
    void write(const std::string& path, const std::function<void()>& writer);
    /// What else belongs to the end, such as a summary: what it throws is kept like that of a file.
    void attempt(const std::function<void()>& action);
    void addFailure(std::exception_ptr failure) { failures_.push_back(std::move(failure)); }

    const std::vector<std::string>& paths() const { return paths_; }
    /// Throws the first failure and says the others; nothing where there is none.
    void rethrow() const;

private:
    std::vector<std::string> paths_;
    std::vector<std::exception_ptr> failures_;
};

} // namespace quasilux
