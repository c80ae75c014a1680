// ?VIEW: pictures of cameras for the clients that have asked. The camera's thread draws; here is who waits for it.
#pragma once

#include "daemon/socket/picture.h"
#include "daemon/socket/roster.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace locus {

class Views {
  public:
    using ClientId = std::uint64_t;
    /// A whole line for a client, which may be gone.
    using Answer = std::function<void(ClientId client, const std::string& line)>;

    /// Empty: the answer comes through serve(). Else the sentence of why there will be none.
    std::string ask(ClientId client, const std::string& camera, const Picture& picture, const Roster& roster,
                    Timestamp now);

    /// Answers whose picture has come, and who has waited in vain.
    void serve(const Roster& roster, Timestamp now, const Answer& answer);

  private:
    struct Waiting {
        ClientId client;
        std::string camera;
        Timestamp since;
    };
    std::vector<Waiting> waiting_;
};

} // namespace locus
