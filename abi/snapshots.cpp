#include "check.h"
#include "guard.h"
#include "scene_table.h"

using namespace peregrine;
using namespace peregrine::abi;

rt_result rt_hold_snapshot(rt_scene scene, rt_snapshot* out_snapshot) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        require_pointer(out_snapshot, "out_snapshot");
        const base::Handle held = host.scene.snapshots.hold();
        if (!held)
            base::fail(base::Code::not_committed,
                       "the scene has no snapshot to hold yet: call rt_commit_scene");
        *out_snapshot = to_host<rt_snapshot>(held);
    });
}

rt_result rt_release_snapshot(rt_scene scene, rt_snapshot snapshot) noexcept {
    return guard([&] {
        HostScene& host = find_scene(scene);
        if (!host.scene.snapshots.release(to_handle(snapshot)))
            fail_handle(to_handle(snapshot), "rt_snapshot", "held snapshot");
    });
}
