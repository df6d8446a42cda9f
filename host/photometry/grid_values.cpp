#include "photometry/grid_values.h"

#include "util/error.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <glm/glm.hpp>

namespace quasilux {

namespace {

std::vector<std::string> cellsOf(const std::string& line) {
    std::vector<std::string> cells(1);
    for (const char c : line)
        if (c == ',')
            cells.emplace_back();
        else if (c != '\r')
            cells.back() += c;
    return cells;
}

class TableReader {
public:
    TableReader(const std::string& path, GridQuantity quantity, const std::string& grid)
        : path_(path), name_(quantity == GridQuantity::illuminance ? "illuminance" : "daylight_factor"), wanted_(grid),
          file_(path) {
        if (!file_) throw InputError(fmt::format("cannot read the grid '{}': no such file, or no permission", path));
    }

    GridValues read() {
        for (std::string line; std::getline(file_, line);) {
            ++line_;
            if (line.starts_with("# units: radiometric per nanometre")) grid_.isPerNanometre = true;
            if (line.empty() || line.front() == '#') continue;
            if (columns_.empty())
                columns_ = cellsOf(line);
            else
                readRow(cellsOf(line));
        }
        checkChoice();
        if (places_.empty()) fail("there are no points, expected a table as `quasilux render --grid` writes it");
        measure();
        if (!hasErrors_) grid_.standardError.clear();
        return grid_;
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(SourceLocation{path_, line_}, what + ".");
    }

    size_t column(const std::string& name) const {
        const auto found = std::find(columns_.begin(), columns_.end(), name);
        if (found == columns_.end())
            fail(fmt::format("the table has no column '{}', expected one as `quasilux render --grid{}` writes it", name,
                             name == "daylight_factor" ? " --daylight-factor" : ""));
        return static_cast<size_t>(found - columns_.begin());
    }

    double number(const std::vector<std::string>& cells, const std::string& name) const {
        const std::string& text = cells[column(name)];
        double value = 0;
        const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (problem != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
            fail(fmt::format("column '{}': '{}' is not a finite number", name, text));
        return value;
    }

    /// A table of several grids has their names before the points.
    void readRow(const std::vector<std::string>& cells) {
        if (cells.size() != columns_.size())
            fail(fmt::format("{} columns, expected {} as the names have", cells.size(), columns_.size()));
        const bool hasNames = columns_.front() == "grid";
        if (hasNames && std::find(grids_.begin(), grids_.end(), cells.front()) == grids_.end())
            grids_.push_back(cells.front());
        const std::string& wanted = wanted_.empty() && hasNames ? grids_.front() : wanted_;
        if (!hasNames || cells.front() == wanted) addRow(cells);
    }

    void checkChoice() const {
        if (wanted_.empty() ? grids_.size() < 2 : std::find(grids_.begin(), grids_.end(), wanted_) != grids_.end())
            return;
        if (grids_.empty())
            fail(fmt::format("the table has one grid without a name, not '{}'; leave --grid out", wanted_));
        fail(fmt::format("the table has the grids {}, {}", fmt::join(grids_, ", "),
                         wanted_.empty() ? "choose one by --grid NAME" : fmt::format("not '{}'", wanted_)));
    }

    void addRow(const std::vector<std::string>& cells) {
        const double i = number(cells, "i"), j = number(cells, "j");
        // Row by row: the next column, or the first one of the next row.
        const bool isNext =
            places_.empty() ? i == 0 && j == 0 : (i == lastI_ + 1 && j == lastJ_) || (i == 0 && j == lastJ_ + 1);
        if (!isNext) fail(fmt::format("point {}, {} is out of order, expected them row by row", i, j));
        lastI_ = i;
        lastJ_ = j;
        grid_.nx = std::max(grid_.nx, static_cast<unsigned>(i) + 1);
        grid_.ny = std::max(grid_.ny, static_cast<unsigned>(j) + 1);
        places_.emplace_back(number(cells, "x"), number(cells, "y"), number(cells, "z"));
        grid_.values.push_back(number(cells, name_));
        if (cells[column(name_ + "_stderr")].empty())
            hasErrors_ = false;
        else
            grid_.standardError.push_back(number(cells, name_ + "_stderr"));
    }

    /// Points are the centres of cells.
    void measure() {
        if (places_.size() != size_t{grid_.nx} * grid_.ny)
            fail(fmt::format("{} points, expected {} x {}", places_.size(), grid_.nx, grid_.ny));
        const double u = grid_.nx > 1 ? glm::length(places_[1] - places_[0]) : 0,
                     v = grid_.ny > 1 ? glm::length(places_[grid_.nx] - places_[0]) : 0;
        if (!(u + v > 0)) fail("the grid is a single point: there is nothing to draw");
        grid_.lengthU = (u > 0 ? u : v) * grid_.nx; // the size of a lone row is not in the table
        grid_.lengthV = (v > 0 ? v : u) * grid_.ny;
    }

    std::string path_, name_, wanted_;
    std::vector<std::string> grids_;
    std::ifstream file_;
    int line_ = 0;
    std::vector<std::string> columns_;
    std::vector<glm::dvec3> places_;
    double lastI_ = 0, lastJ_ = 0;
    bool hasErrors_ = true;
    GridValues grid_;
};

} // namespace

GridValues readGridTable(const std::string& path, GridQuantity quantity, const std::string& grid) {
    GridValues values = TableReader(path, quantity, grid).read();
    if (quantity == GridQuantity::daylightFactor) {
        values.unit = "%";
        values.isPerNanometre = false; // a ratio
    }
    return values;
}

} // namespace quasilux
