// The page and what it asks for, by HTTP. All paths begin with the token; no request reads a file.
#pragma once

#include "view/access.h"
#include "view/live_view.h"

#include <memory>

namespace quasilux {

class ViewServer {
public:
    /// Throws InputError where the address cannot be had.
    ViewServer(const ViewOptions& options, LiveView& view);
    ~ViewServer();

    std::string address() const;

private:
    struct Http;
    std::unique_ptr<Http> http_;
};

} // namespace quasilux
