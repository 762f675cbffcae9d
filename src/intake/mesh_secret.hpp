// What tells this user's own files from those that came with a deck.
#pragma once

#include <string>

namespace dygita {

// 32 random bytes of this user, in $XDG_STATE_HOME/dygita (else ~/.local/state/dygita), made at the first call; empty
// where they can be neither read nor made, or others could have: then nothing is signed and nothing is believed.
std::string own_secret();

}  // namespace dygita
