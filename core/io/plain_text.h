// SPDX-License-Identifier: Apache-2.0
// Text from strangers, made fit to show; numbers in text, whatever the system's language.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace whorl {

/// `text` as valid UTF-8 without control characters, line breaks or characters that turn the writing direction, cut at
/// `maxBytes` between characters. For names and for error texts that quote a file.
std::string plainText(std::string_view text, std::size_t maxBytes = 200);

/// The whole of `word` as a number ("-1.5e3", "+2", "nan", "inf"); nothing when any of it is something else.
/// Always a decimal point, whatever the locale. Too large becomes infinite, too small zero.
std::optional<float> parseFloat(std::string_view word);
std::optional<long long> parseInteger(std::string_view word);

}  // namespace whorl
