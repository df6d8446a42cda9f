#include "ranks/mpi/collectives.h"

#include "render/film_merge.h"
#include "util/error.h"

#include <algorithm>
#include <climits>

namespace quasilux {

namespace {

constexpr size_t pixelsAtOnce = size_t(1) << 18;

FilmLayout layoutOfSums; // an operation of MPI takes no further argument; all films of a job's render have one layout

void addPixels(void* in, void* inOut, int* pixels, MPI_Datatype*) {
    mergeFilmSums(static_cast<float*>(inOut), {}, static_cast<const float*>(in), {}, static_cast<size_t>(*pixels),
                  layoutOfSums);
}

MPI_Comm ofBroadcasts = MPI_COMM_NULL, ofReductions = MPI_COMM_NULL;

int rankHere() {
    int rank = 0;
    MPI_Comm_rank(ofReductions, &rank);
    return rank;
}

bool isComplete(MPI_Request& request) {
    int isDone = 0;
    MPI_Test(&request, &isDone, MPI_STATUS_IGNORE);
    return isDone != 0;
}

} // namespace

void openCollectives() {
    MPI_Comm_dup(MPI_COMM_WORLD, &ofBroadcasts);
    MPI_Comm_dup(MPI_COMM_WORLD, &ofReductions);
}

void closeCollectives() {
    MPI_Comm_free(&ofBroadcasts);
    MPI_Comm_free(&ofReductions);
}

Broadcast::Broadcast(std::vector<char> bytes) : bytes_(std::move(bytes)) {
    if (bytes_.size() > INT_MAX) throw DeviceError("what was learned is longer than MPI can send");
    MPI_Ibcast(bytes_.data(), static_cast<int>(bytes_.size()), MPI_BYTE, 0, ofBroadcasts, &request_);
}

Broadcast::~Broadcast() { MPI_Wait(&request_, MPI_STATUS_IGNORE); }

bool Broadcast::isDone() { return isComplete(request_); }

FilmReduction::FilmReduction(std::vector<float> film, const Renderer::FilmShape& shape)
    : film_(std::move(film)), pixels_(size_t(shape.width) * shape.height), floats_(shape.layout.floatsPerPixel()),
      isRoot_(rankHere() == 0) {
    film_.resize(pixels_ * floats_);
    layoutOfSums = shape.layout;
    MPI_Type_contiguous(static_cast<int>(floats_), MPI_FLOAT, &pixel_);
    MPI_Type_commit(&pixel_);
    MPI_Op_create(addPixels, 1, &add_);
    beginPiece();
}

FilmReduction::~FilmReduction() {
    MPI_Wait(&request_, MPI_STATUS_IGNORE);
    MPI_Op_free(&add_);
    MPI_Type_free(&pixel_);
}

void FilmReduction::beginPiece() {
    const size_t count = std::min(pixelsAtOnce, pixels_ - first_);
    if (isRoot_) sums_.resize(count * floats_);
    MPI_Ireduce(film_.data() + first_ * floats_, sums_.data(), static_cast<int>(count), pixel_, add_, 0, ofReductions,
                &request_);
}

bool FilmReduction::isDone() {
    while (first_ < pixels_) {
        if (!isComplete(request_)) return false;
        if (isRoot_)
            std::copy(sums_.begin(), sums_.end(), film_.begin() + static_cast<std::ptrdiff_t>(first_ * floats_));
        first_ += std::min(pixelsAtOnce, pixels_ - first_);
        if (first_ < pixels_) beginPiece();
    }
    return true;
}

} // namespace quasilux
