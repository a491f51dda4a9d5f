// SPDX-License-Identifier: Apache-2.0
// Long work in a thread of its own, with a dialog that shows how far it is and can stop it.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"

#include <QString>
#include <functional>
#include <optional>

class QWidget;

namespace whorl {

/// Runs `work` in another thread and returns when it is done. Meanwhile the window draws but takes no input; after
/// 0.4 s a dialog (object name "progress_dialog") shows the progress and a Cancel button.
void runInBackground(QWidget* parent, const QString& title, const std::function<void(Progress&)>& work);

/// The same for work with a result.
template <class T>
Result<T> runWithProgress(QWidget* parent, const QString& title, const std::function<Result<T>(Progress&)>& work) {
    std::optional<Result<T>> result;
    runInBackground(parent, title, [&](Progress& progress) { result.emplace(work(progress)); });
    return std::move(*result);
}

}  // namespace whorl
