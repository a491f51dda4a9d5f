// SPDX-License-Identifier: Apache-2.0
#include "editor/app/progress_task.h"

#include <QEventLoop>
#include <QProgressDialog>
#include <QTimer>
#include <atomic>
#include <mutex>
#include <thread>

namespace whorl {

void runInBackground(QWidget* parent, const QString& title, const std::function<void(Progress&)>& work) {
    std::mutex mutex;
    QString what;
    std::atomic<int> percent{0};
    std::atomic<bool> done{false};
    Progress progress([&](float fraction, std::string_view text) {
        percent = static_cast<int>(fraction * 100.0f);
        const std::lock_guard lock(mutex);
        what = QString::fromUtf8(text.data(), static_cast<qsizetype>(text.size()));
    });
    QEventLoop loop;
    std::thread thread([&] {
        work(progress);
        done = true;
        QMetaObject::invokeMethod(
            &loop, [&loop] { loop.quit(); }, Qt::QueuedConnection);
    });

    // Short work shows nothing. Clicks made meanwhile wait, so that they do not meet a half-changed document.
    QTimer patience;
    patience.setSingleShot(true);
    QObject::connect(&patience, &QTimer::timeout, &loop, &QEventLoop::quit);
    patience.start(400);
    loop.exec(QEventLoop::ExcludeUserInputEvents);
    if (!done) {
        QProgressDialog dialog(title, QObject::tr("Cancel"), 0, 100, parent);
        dialog.setObjectName("progress_dialog");
        dialog.setWindowTitle(title);
        dialog.setWindowModality(Qt::ApplicationModal);
        dialog.setMinimumDuration(0);
        dialog.setAutoClose(false);
        dialog.setAutoReset(false);
        dialog.setMinimumWidth(380);
        QObject::connect(&dialog, &QProgressDialog::canceled, [&] {
            progress.cancel();
            dialog.setLabelText(QObject::tr("Stopping…"));
        });
        QTimer refresh;
        QObject::connect(&refresh, &QTimer::timeout, &dialog, [&] {
            if (progress.cancelled()) return;
            dialog.setValue(percent);
            const std::lock_guard lock(mutex);
            dialog.setLabelText(what.isEmpty() ? title : what);
        });
        refresh.start(60);
        dialog.show();
        while (!done) loop.exec();
    }
    thread.join();
}

}  // namespace whorl
