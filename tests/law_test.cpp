// The law of kernels/law.clh on random finite-dimensional operators: matrices stand in for the scattering operators
// F_d, F_qs and the transport operator T. Walking every camera path at once and summing what the kernels' table takes
// at each hit must give L = F E exactly, for every BDD; the known wrong readings must not.
#include "shared_types.h"
#include "support/test_kernels.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace quasilux {
namespace {

constexpr int size = 12;
using Vector = std::array<double, size>;
using Matrix = std::array<Vector, size>;

Vector operator+(Vector a, const Vector& b) {
    for (int i = 0; i < size; ++i) a[i] += b[i];
    return a;
}
Matrix operator+(Matrix a, const Matrix& b) {
    for (int i = 0; i < size; ++i) a[i] = a[i] + b[i];
    return a;
}
Vector operator*(const Matrix& m, const Vector& v) {
    Vector out{};
    for (int i = 0; i < size; ++i)
        for (int j = 0; j < size; ++j) out[i] += m[i][j] * v[j];
    return out;
}
Matrix operator*(const Matrix& a, const Matrix& b) {
    Matrix out{};
    for (int i = 0; i < size; ++i)
        for (int k = 0; k < size; ++k)
            for (int j = 0; j < size; ++j) out[i][j] += a[i][k] * b[k][j];
    return out;
}
double length(const Vector& v) {
    double sum = 0;
    for (const double x : v) sum += x * x;
    return std::sqrt(sum);
}

// A non-negative random matrix of the given spectral norm (power iteration on A^T A).
Matrix randomOperator(std::mt19937& random, double norm) {
    std::uniform_real_distribution<double> uniform;
    Matrix a, transposed;
    for (int i = 0; i < size; ++i)
        for (int j = 0; j < size; ++j) transposed[j][i] = a[i][j] = uniform(random);
    Vector v;
    v.fill(1);
    double spectral = 0;
    for (int k = 0; k < 200; ++k) {
        v = transposed * (a * v);
        spectral = std::sqrt(length(v));
        const double scale = length(v);
        for (double& x : v) x /= scale;
    }
    for (auto& row : a)
        for (double& x : row) x *= norm / spectral;
    return a;
}

// E = E0 + K E by its Neumann series.
Vector solve(const Matrix& k, const Vector& e0) {
    Vector sum = e0, term = e0;
    for (int i = 0; i < 2000; ++i) {
        term = k * term;
        sum = sum + term;
    }
    return sum;
}

struct Operators {
    Matrix diffuse, quasiSpecular, transport;
    Vector e0, quasiCaustic, indirect, radiance; ///< radiance = F E, the truth

    Operators() {
        std::mt19937 random(1);
        std::uniform_real_distribution<double> uniform;
        diffuse = randomOperator(random, 0.5);
        quasiSpecular = randomOperator(random, 0.35);
        transport = randomOperator(random, 0.95);
        for (double& x : e0) x = uniform(random);
        const Matrix f = diffuse + quasiSpecular;
        const Vector e = solve(transport * f, e0);
        const Vector e0AndQuasiCaustic = solve(transport * quasiSpecular, e0);
        for (int i = 0; i < size; ++i) {
            quasiCaustic[i] = e0AndQuasiCaustic[i] - e0[i];
            indirect[i] = e[i] - e0AndQuasiCaustic[i];
        }
        radiance = f * e;
    }
};

// kernels/law.clh as a table, from the device.
struct LawTable {
    std::vector<uint32_t> taken, mayScatter;

    explicit LawTable(const std::string& options, uint32_t variant = VARIANT_MAIN) {
        Buffer<uint32_t> takenOnDevice(testDevice(), 64, "taken"), scatterOnDevice(testDevice(), 64, "scatter");
        testProgram("law.cl", options).kernel("tabulateLaw").launch(64, takenOnDevice, scatterOnDevice, variant);
        taken = takenOnDevice.read();
        mayScatter = scatterOnDevice.read();
    }
    static size_t index(bool quasiSpecular, unsigned d, unsigned q, unsigned bdd) {
        return (quasiSpecular ? 1 : 0) | d << 1 | std::min(q, 1u) << 3 | bdd << 4;
    }
};

Vector lightOf(uint32_t classes, const Operators& o) {
    Vector light{};
    // E0 = direct + caustic: the law always takes both.
    EXPECT_EQ(classes >> LIGHT_DIRECT & 1, classes >> LIGHT_CAUSTIC & 1);
    if (classes >> LIGHT_DIRECT & 1) light = light + o.e0;
    if (classes >> LIGHT_QUASI_CAUSTIC & 1) light = light + o.quasiCaustic;
    if (classes >> LIGHT_DIFFUSE & 1) light = light + o.indirect;
    return light;
}

// Largest relative error of the walk over all camera paths with this table.
double walkError(const LawTable& law, const Operators& o, unsigned bdd) {
    Matrix identity{};
    for (int i = 0; i < size; ++i) identity[i][i] = 1;
    std::map<std::pair<unsigned, unsigned>, Matrix> paths{{{0, 0}, identity}};
    Vector total{};
    for (int event = 0; event < 400; ++event) {
        std::map<std::pair<unsigned, unsigned>, Matrix> after;
        for (const auto& [state, weight] : paths) {
            const auto [d, q] = state;
            const auto diffuse = LawTable::index(false, d, q, bdd), special = LawTable::index(true, d, q, bdd);
            total = total + weight * (o.diffuse * lightOf(law.taken[diffuse], o) +
                                      o.quasiSpecular * lightOf(law.taken[special], o));
            if (law.mayScatter[special]) after[{d, 1}] = after[{d, 1}] + weight * o.quasiSpecular * o.transport;
            if (law.mayScatter[diffuse]) after[{d + 1, q}] = after[{d + 1, q}] + weight * o.diffuse * o.transport;
        }
        paths = std::move(after);
    }
    double error = 0, scale = 0;
    for (int i = 0; i < size; ++i) {
        error = std::max(error, std::abs(total[i] - o.radiance[i]));
        scale = std::max(scale, std::abs(o.radiance[i]));
    }
    return error / scale;
}

const Operators& operators() {
    static const Operators instance;
    return instance;
}

TEST(Law, MainVariantGivesTheTruthForEveryBdd) {
    const LawTable law("");
    for (unsigned bdd = 0; bdd < 4; ++bdd) EXPECT_LT(walkError(law, operators(), bdd), 1e-12) << "BDD " << bdd;
}

TEST(Law, AlternativeVariantGivesTheTruthForEveryBdd) {
    const LawTable law("", VARIANT_ALTERNATIVE);
    for (unsigned bdd = 0; bdd < 4; ++bdd) EXPECT_LT(walkError(law, operators(), bdd), 1e-12) << "BDD " << bdd;
}

// Negative controls: the walk must notice each known wrong reading wherever it is wrong.
TEST(Law, WrongReadingsAreCaught) {
    for (unsigned bdd = 0; bdd < 4; ++bdd) {
        const double untilFirst = walkError(LawTable("-DLAW_RULE=1"), operators(), bdd);
        const double everyHit = walkError(LawTable("-DLAW_RULE=2"), operators(), bdd);
        const double fullChain = walkError(LawTable("-DLAW_RULE=3"), operators(), bdd);
        if (bdd > 0) { // without a genuine diffuse scattering the first two cannot differ from the law
            EXPECT_GT(untilFirst, 1e-2) << "BDD " << bdd;
            EXPECT_GT(everyHit, 1e-2) << "BDD " << bdd;
        }
        EXPECT_GT(fullChain, 1e-2) << "BDD " << bdd;
    }
}

TEST(Law, PhotonClassesFollowTheEventsSinceTheLight) {
    Buffer<uint32_t> onDevice(testDevice(), 8, "classes");
    testProgram("law.cl").kernel("tabulateClasses").launch(8, onDevice);
    const auto classes = onDevice.read();
    for (unsigned events = 0; events < 8; ++events) {
        unsigned expected = LIGHT_DIRECT;
        if (events & SCATTER_SPECULAR) expected = LIGHT_CAUSTIC;
        if (events & SCATTER_QUASI_SPECULAR) expected = LIGHT_QUASI_CAUSTIC;
        if (events & SCATTER_GENUINE_DIFFUSE) expected = LIGHT_DIFFUSE;
        EXPECT_EQ(classes[events], expected) << "events " << events;
    }
}

TEST(Law, SpecularLobesTakeNothingAndNeverEndAPath) {
    Buffer<uint32_t> taken(testDevice(), 1, "taken"), mayScatter(testDevice(), 1, "scatter");
    testProgram("law.cl").kernel("tabulateSpecular").launch(1, taken, mayScatter, uint32_t{VARIANT_MAIN});
    EXPECT_EQ(taken.read().front(), 0u);
    EXPECT_EQ(mayScatter.read().front(), 1u);
}

} // namespace
} // namespace quasilux
