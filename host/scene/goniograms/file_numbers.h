// Numbers of a text file one after the other, whatever the lines, with the line of each for messages.
#pragma once

#include "util/error.h"

#include <string>
#include <string_view>
#include <vector>

namespace quasilux {

/// Lines without their ends, LF, CR LF, or CR alone, and without a byte order mark.
std::vector<std::string_view> splitLines(std::string_view text);

/// Without regard to case, which files have either way.
bool isWord(std::string_view text, std::string_view word);

/// Without those about it.
std::string_view withoutBlanks(std::string_view text);

/// Whether it begins like a number; what it is worth, parseNumber says.
bool beginsAsNumber(std::string_view text);

/// Every query names what is read, for messages, and throws InputError at its line.
class NumberReader {
public:
    virtual ~NumberReader() = default;
    virtual double number(const std::string& what) = 0;
    /// Of the number that was read last.
    virtual SourceLocation where() const = 0;

    double numberFrom(const std::string& what, double lowest);
    /// Not below 0, but for what is left of a dark signal, which becomes 0; `rejectNegative` says what is too much.
    double intensity(const std::string& what);
    /// Throws InputError where an intensity was further below 0 than a thousandth of the largest one.
    void rejectNegative(const std::string& what, std::vector<std::string>& warnings) const;
    [[noreturn]] void fail(const std::string& message) const { throw InputError(where(), message); }

protected:
    /// Adds one that is greater than the last of `values`.
    void addLarger(std::vector<double>& values, double value, const std::string& what) const;

private:
    double largest_ = 0, least_ = 0; ///< of the intensities
    SourceLocation whereLeast_;
};

/// Numbers one after the other, however they are spread over lines.
class FileNumbers : public NumberReader {
public:
    /// Of lines[first …]; line numbers count from 1.
    FileNumbers(std::string path, const std::vector<std::string_view>& lines, size_t first);

    double number(const std::string& what) override;
    /// Greater than 0.
    double positive(const std::string& what);
    unsigned integer(const std::string& what, unsigned lowest, unsigned highest);
    /// Each greater than the one before, within [lowest, highest].
    std::vector<double> increasing(const std::string& what, unsigned count, double lowest, double highest);
    /// How many are left.
    size_t left() const { return pieces_.size() - next_; }
    /// Whether so many pieces on text stands, and no number.
    bool isText(size_t further) const;
    /// Throws InputError at the first piece of those left that is no number.
    void expectNumbers(const std::string& what) const;
    /// Throws InputError where there are more numbers, and warns of other text.
    void finish(const std::string& what, std::vector<std::string>& warnings) const;
    SourceLocation where() const override;

private:
    struct Piece {
        std::string_view text;
        int line;
    };
    const Piece& take(const std::string& what);

    std::string path_;
    std::vector<Piece> pieces_;
    size_t next_ = 0;
    int lastLine_;
};

} // namespace quasilux
