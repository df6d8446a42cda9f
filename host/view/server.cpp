// The only file that knows the HTTP library.
#include "view/server.h"

#include "output/exr.h"
#include "scene/xml/xml_document.h"
#include "util/stopwatch.h"
#include "util/temporary_folder.h"
#include "view/frame.h"
#include "view/frame_pace.h"
#include "view/page_files.h"

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sstream>
#include <sys/socket.h>
#include <thread>

namespace quasilux {

namespace {

using Clock = Errands::Clock;
using httplib::Request;
using httplib::Response;

// Threads, of which each request that waits for something new takes one.
constexpr size_t serverThreads = 24;
constexpr int keepAliveSeconds = 1;
constexpr std::chrono::milliseconds patience{3000}, patienceOfSaving{600000};

constexpr int badRequest = 400, forbidden = 403, notFound = 404, noContent = 204, unsupportedType = 415;

// A page from elsewhere can neither be shown ours in a frame nor read anything of it; ours runs only what lies here.
const httplib::Headers safetyHeaders{
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; connect-src "
     "'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
    {"X-Content-Type-Options", "nosniff"},
    {"Referrer-Policy", "no-referrer"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Cache-Control", "no-store"}};

std::string typeOf(const std::string& file) {
    const std::string end = file.substr(file.rfind('.') + 1);
    return end == "html"  ? "text/html; charset=utf-8"
           : end == "js"  ? "text/javascript; charset=utf-8"
           : end == "css" ? "text/css; charset=utf-8"
                          : "image/svg+xml";
}

uint64_t wholeParameter(const Request& request, const char* name, uint64_t otherwise) {
    if (!request.has_param(name)) return otherwise;
    const std::string text = request.get_param_value(name);
    const bool isNumber =
        !text.empty() && text.size() < 16 && text.find_first_not_of("0123456789") == std::string::npos;
    if (!isNumber) throw InputError(fmt::format("{} is '{}', expected a whole number", name, text));
    return std::stoull(text);
}

// More than any film has along a side.
constexpr unsigned longestSide = 1u << 30;

unsigned pixelsParameter(const Request& request, const char* name, unsigned otherwise) {
    return static_cast<unsigned>(std::min<uint64_t>(wholeParameter(request, name, otherwise), longestSide));
}

double numberParameter(const Request& request, const char* name, double otherwise) {
    if (!request.has_param(name)) return otherwise;
    std::istringstream text(request.get_param_value(name));
    double value = 0;
    if (!(text >> value) || !text.eof() || !std::isfinite(value) || value <= 0)
        throw InputError(fmt::format("{} is '{}', expected a number above 0", name, text.str()));
    return value;
}

uint16_t portOf(const sockaddr_storage& address) {
    return ntohs(address.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(address).sin6_port
                                               : reinterpret_cast<const sockaddr_in&>(address).sin_port);
}

/// Ends all connections that this program has accepted at the port: the library knows them no more.
void dropConnections(int port) {
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
        const int socket = std::atoi(entry.path().filename().c_str());
        sockaddr_storage own{}, other{};
        socklen_t ownSize = sizeof own, otherSize = sizeof other;
        const bool isConnected = getsockname(socket, reinterpret_cast<sockaddr*>(&own), &ownSize) == 0 &&
                                 getpeername(socket, reinterpret_cast<sockaddr*>(&other), &otherSize) == 0;
        if (isConnected && (own.ss_family == AF_INET || own.ss_family == AF_INET6) && portOf(own) == port)
            shutdown(socket, SHUT_RDWR);
    }
}

void reply(Response& response, const nlohmann::json& json) {
    response.set_content(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), "application/json");
}

} // namespace

struct ViewServer::Http {
    Http(const ViewOptions& options, LiveView& view_) : view(view_), access(options.listen), listen(options.listen) {
        server.new_task_queue = [] { return new httplib::ThreadPool(serverThreads); }; // the library deletes it
        // By default another program could listen on the same port.
        server.set_socket_options([](socket_t socket) {
            const int yes = 1;
            setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        });
        server.set_default_headers(safetyHeaders);
        server.set_keep_alive_timeout(
            keepAliveSeconds); // as long may the end of the program have to wait for an idle browser
        server.set_keep_alive_max_count(1000);
        server.set_payload_max_length(1u << 18);
        server.set_tcp_nodelay(true);
        setHandlers();
        port = options.port == 0                                             ? server.bind_to_any_port(listen)
               : server.bind_to_port(listen, static_cast<int>(options.port)) ? static_cast<int>(options.port)
                                                                             : -1;
        if (port <= 0)
            throw InputError(
                fmt::format("--listen {} --port {}: the system refuses this address (another program may have it); "
                            "give another one, or --port 0 for any that is free",
                            listen, options.port));
        thread = std::thread([this] {
            server.listen_after_bind();
            hasEnded = true;
        });
        while (!server.is_running()) std::this_thread::yield(); // or else stop() may come too early
    }

    /// Threads of the library read as long as somebody sends a byte now and then, and the image waits for them here.
    ~Http() {
        server.stop();
        const Stopwatch watch;
        while (!hasEnded) {
            if (watch.seconds() > keepAliveSeconds) dropConnections(port);
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        thread.join();
    }

    Http(const Http&) = delete;
    Http& operator=(const Http&) = delete;

    void setHandlers() {
        server.set_pre_routing_handler([this](const Request& request, Response& response) {
            if (mayAsk(request)) return httplib::Server::HandlerResponse::Unhandled;
            response.status = forbidden;
            response.set_content("The address lacks the token that `quasilux` printed, or names another computer.\n",
                                 "text/plain");
            return httplib::Server::HandlerResponse::Handled;
        });
        const auto get = [this](const std::string& name, void (Http::*answer)(const Request&, Response&)) {
            server.Get("/" + access.token() + name, guarded(answer));
        };
        get("/state", &Http::state);
        get("/frame", &Http::frame);
        get("/pixel", &Http::pixel);
        get("/image\\.(exr|png)", &Http::image);
        get("/([a-z_]*(?:\\.[a-z]+)?)", &Http::file);
        server.Post("/" + access.token() + "/stop", guarded(&Http::stop));
        server.Post("/" + access.token() + "/edit", guarded(&Http::edit));
    }

    // The first part of the path is the token.
    bool mayAsk(const Request& request) const {
        if (!access.isOurHost(request.get_header_value("Host"), port)) return false;
        const auto end = request.path.find('/', 1);
        return end != std::string::npos && access.isToken(request.path.substr(1, end - 1));
    }

    httplib::Server::Handler guarded(void (Http::*answer)(const Request&, Response&)) {
        return [this, answer](const Request& request, Response& response) {
            try {
                (this->*answer)(request, response);
            } catch (const InputError& error) {
                response.status = badRequest;
                reply(response, {{"error", error.what()}});
            } catch (const std::exception& error) {
                response.status = 500;
                reply(response, {{"error", error.what()}});
            }
        };
    }

    void file(const Request& request, Response& response) {
        const std::string name = request.matches[1].length() == 0 ? "index.html" : request.matches[1].str();
        const auto& files = pageFiles();
        const auto found = files.find(name);
        if (found == files.end())
            response.status = notFound;
        else
            response.set_content(found->second, typeOf(name));
    }

    void state(const Request& request, Response& response) {
        reply(response, view.state().wait(wholeParameter(request, "seen", 0), patience));
    }

    // A picture newer than `after`; 204 where there is none for a while.
    void frame(const Request& request, Response& response) {
        FrameWish wish;
        if (request.has_param("layer")) wish.layer = request.get_param_value("layer");
        wish.x = pixelsParameter(request, "x", 0);
        wish.y = pixelsParameter(request, "y", 0);
        wish.width = pixelsParameter(request, "width", longestSide);
        wish.height = pixelsParameter(request, "height", longestSide);
        wish.step = pixelsParameter(request, "step", 1);
        const uint64_t after = wholeParameter(request, "after", 0);
        FilmCutChoice choice;
        FilmImage cut;
        nlohmann::json origin;
        uint64_t moment = 0;
        bool isWhole = false;
        const bool isDone = view.errands().run(
            [&](const RenderMoment& now) {
                const auto start = Clock::now();
                const Film& film = now.renderer.film();
                choice = cutFor(wish, film, now.goesOn ? std::optional(pace.mostPixels()) : std::nullopt);
                isWhole = choice.width == film.width() && choice.height == film.height();
                cut = view.cutter().develop(film, static_cast<unsigned>(now.renderer.counters().passes), choice);
                origin = view.state().origin();
                moment = now.number;
                pace.note(view.renders(), pixelsRead(choice), start, Clock::now());
            },
            {after, after > 0 ? pace.next(view.renders()) : Clock::time_point{}, isValueLayer(wish.layer)}, patience);
        if (!isDone) {
            response.status = noContent;
            return;
        }
        const Frame made = makeFrame(wish, choice, cut, isWhole && !choice.component ? 0 : meanRadiance.load());
        if (isWhole && !choice.component) meanRadiance = made.meanRadiance;
        origin.update({{"layer", wish.layer}, {"moment", moment}});
        sendFrame(made, std::move(origin), response);
    }

    // `header`: what the frame itself does not know.
    static void sendFrame(const Frame& frame, nlohmann::json header, Response& response) {
        header.update({{"x", frame.x},
                       {"y", frame.y},
                       {"step", frame.step},
                       {"width", frame.width},
                       {"height", frame.height},
                       {"channels", frame.channels},
                       {"passes", frame.passes},
                       {"isKnown", frame.isKnown},
                       {"scale", frame.scale},
                       {"exposure", frame.curve.scale},
                       {"white", frame.curve.white}});
        // In ASCII, as names in the settings may be any text.
        response.set_header("X-Frame", header.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace));
        response.set_content(reinterpret_cast<const char*>(frame.halves.data()), frame.halves.size() * sizeof(uint16_t),
                             "application/octet-stream");
    }

    void pixel(const Request& request, Response& response) {
        FilmCutChoice choice;
        choice.x = pixelsParameter(request, "x", 0);
        choice.y = pixelsParameter(request, "y", 0);
        choice.width = choice.height = 1;
        choice.content = FilmCutChoice::Content::all;
        FilmImage one;
        const bool isDone = view.errands().run(
            [&](const RenderMoment& now) {
                const Film& film = now.renderer.film();
                if (choice.x >= film.width() || choice.y >= film.height())
                    throw InputError(fmt::format("pixel {}, {} is none of {} x {}", choice.x, choice.y, film.width(),
                                                 film.height()));
                one = view.cutter().develop(film, static_cast<unsigned>(now.renderer.counters().passes), choice);
            },
            {}, patience);
        if (!isDone) {
            response.status = noContent;
            return;
        }
        reply(response, pixelJson(choice, one));
    }

    static nlohmann::json pixelJson(const FilmCutChoice& choice, const FilmImage& one) {
        const auto orNull = [](const std::vector<float>& values, bool isKnown) {
            return isKnown && !values.empty() ? nlohmann::json(values) : nlohmann::json();
        };
        nlohmann::json json{{"x", choice.x},
                            {"y", choice.y},
                            {"value", one.radiance},
                            {"stderr", orNull(one.standardError, one.isErrorKnown())},
                            {"bias", orNull(one.bias, true)},
                            {"biasStderr", orNull(one.biasError, one.isErrorKnown())},
                            {"passes", one.passes}};
        json["components"] = nlohmann::json::object();
        for (unsigned c = 0; c < FILM_COMPONENTS; ++c)
            if (const auto& values = one.components[c].radiance; !values.empty())
                json["components"][componentName(c)] = values;
        return json;
    }

    // Made in a folder of our own, which nobody else can name.
    void image(const Request& request, Response& response) {
        const bool isExr = request.matches[1] == "exr";
        std::optional<LiveView::Saved> saved;
        std::vector<AovImage> layers;
        const auto take = [&](const RenderMoment& now) {
            saved = view.saved(now);
            if (isExr) layers = view.layers(now);
        };
        view.errands().run(take, {}, patienceOfSaving);
        if (!saved) {
            response.status = noContent;
            return;
        }
        saved->record.error = estimateError(saved->image);
        const TemporaryFolder folder;
        const auto path = folder.path() / (isExr ? "image.exr" : "image.png");
        if (isExr) {
            writeExr(path.string(), saved->image, saved->record, layers);
        } else {
            ToneCurve curve = chooseToneCurve(saved->image, {});
            curve.scale = numberParameter(request, "exposure", curve.scale);
            curve.white = numberParameter(request, "white", curve.white);
            writePng(path.string(), saved->image, curve, saved->record);
        }
        const std::string name = std::filesystem::path(saved->record.scene).stem().string();
        response.set_header("Content-Disposition",
                            "attachment; filename=\"" + plainName(name) + (isExr ? ".exr\"" : ".png\""));
        response.set_content(readFile(path.string(), {}, "picture"), isExr ? "image/x-exr" : "image/png");
    }

    // Of a header, so without quotes and control characters.
    static std::string plainName(std::string name) {
        for (char& c : name)
            if (c == '"' || c == '\\' || static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e)
                c = '_';
        return name;
    }

    void stop(const Request&, Response& response) {
        view.stop();
        reply(response, nlohmann::json::object());
    }

    void edit(const Request& request, Response& response) {
        if (!view.isEditable()) {
            response.status = forbidden;
            reply(response,
                  {{"error", "this render is only looked at; `quasilux view` serves one that can be changed"}});
            return;
        }
        if (request.get_header_value("Content-Type").rfind("application/json", 0) != 0) {
            response.status = unsupportedType;
            return;
        }
        reply(response, {{"number", view.edit(parseEdits(request.body))}});
    }

    LiveView& view;
    Access access;
    std::string listen;
    int port = 0;
    FramePace pace;
    std::atomic<double> meanRadiance{0}; // of the whole image, by its last picture
    httplib::Server server;
    std::thread thread;
    std::atomic<bool> hasEnded{false};
};

ViewServer::ViewServer(const ViewOptions& options, LiveView& view) : http_(std::make_unique<Http>(options, view)) {}

ViewServer::~ViewServer() = default;

std::string ViewServer::address() const {
    const std::string& listen = http_->listen;
    const bool isAny = listen == "0.0.0.0" || listen == "::";
    const std::string host = isAny                                   ? computerName()
                             : listen.find(':') == std::string::npos ? listen
                                                                     : '[' + listen + ']';
    return fmt::format("http://{}:{}/{}/", host, http_->port, http_->access.token());
}

} // namespace quasilux
