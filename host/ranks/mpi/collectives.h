// What all ranks do together, without waiting: bytes from rank 0 to all, sums of films to rank 0.
#pragma once

#include "render/film_layout.h"
#include "share/pass_sums.h"

#include <mpi.h>
#include <vector>

namespace quasilux {

/// Between the beginning and the end of MPI, by all ranks: broadcasts and reductions go on side by side, so each kind
/// has ranks of its own.
void openCollectives();
void closeCollectives();

/// Bytes of rank 0 to all others; these know how many.
class Broadcast {
public:
    explicit Broadcast(std::vector<char> bytes);
    ~Broadcast();
    Broadcast(const Broadcast&) = delete;
    Broadcast& operator=(const Broadcast&) = delete;

    bool isDone();
    const std::vector<char>& bytes() const { return bytes_; }

private:
    std::vector<char> bytes_;
    MPI_Request request_ = MPI_REQUEST_NULL;
};

/// Films of all ranks, all batches of passes complete, to rank 0, piece by piece: along MPI's tree, which is the same
/// for as many ranks, and to 48 bits, as film_merge.h adds them.
class FilmReduction {
public:
    /// `film`: empty for black.
    FilmReduction(std::vector<float> film, const Renderer::FilmShape& shape);
    ~FilmReduction();
    FilmReduction(const FilmReduction&) = delete;
    FilmReduction& operator=(const FilmReduction&) = delete;

    bool isDone();
    /// On rank 0, once it is done.
    std::vector<float> takeFilm() { return std::move(film_); }

private:
    void beginPiece();

    std::vector<float> film_, sums_; ///< of this rank and then, on rank 0, of all; of a piece
    size_t pixels_, floats_, first_ = 0;
    bool isRoot_;
    MPI_Datatype pixel_ = MPI_DATATYPE_NULL;
    MPI_Op add_ = MPI_OP_NULL;
    MPI_Request request_ = MPI_REQUEST_NULL;
};

} // namespace quasilux
