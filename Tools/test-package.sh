#!/usr/bin/env bash
# Installs a Debian package of Pendular on a bare Debian without a compiler, made by mmdebstrap in a folder, and runs a
# driver and an example of Python in it; then a program and the Python module for each level of the processor, which give
# the same bits. The release is that of this machine, whose libraries a package that was made here needs. As root.
#   Tools/test-package.sh PACKAGE [FOLDER]      default: build/bare-debian, which is removed at the end
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/read-options.sh"
read_argument "$@"
package=${1:-}
if [[ ! -f $package ]]; then refuse "there is no package '$package'; Tools/make-package.sh makes one"; fi
root=${2:-$(dirname "${BASH_SOURCE[0]}")/../build/bare-debian}
command -v mmdebstrap >/dev/null || refuse "mmdebstrap is missing (apt install mmdebstrap)"
if [[ -e $root ]]; then refuse "$root is there already; remove it, or name another folder"; fi
trap 'umount -q "$root/proc"; rm -rf --one-file-system "$root"' EXIT
suite=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
mmdebstrap --quiet --variant=apt "${suite:-stable}" "$root"
mount -t proc proc "$root/proc"  # where programs find their folder, and the module what the processor is
cp "$package" "$root/tmp/pendular.deb"
cp /etc/resolv.conf "$root/etc/resolv.conf"
inside() { chroot "$root" env -i PATH=/usr/bin:/bin:/usr/sbin:/sbin HOME=/tmp MPLBACKEND=Agg DEBIAN_FRONTEND=noninteractive "$@"; }
inside apt-get update -qq
# Without python3-matplotlib, which would bring a compiler.
inside apt-get install -qq --no-install-recommends /tmp/pendular.deb python3-h5py python3-pandas >/dev/null
if inside sh -c 'command -v c++ g++ gcc cc'; then
    echo "test-package.sh: there is a compiler in $root, so this shows nothing." >&2
    exit 1
fi
inside sh -c 'cd /tmp && pendular WetTower | tail -1 && python3 /usr/share/pendular/Examples/restart.py'

# The server of runs in the browser, where the package has its page.
if [[ -e $root/usr/share/pendular/ViewPage/main.js ]]; then
    cat >"$root/tmp/view.py" <<'END'
import contextlib, io, json, urllib.request
import pendular
printed = io.StringIO()
with contextlib.redirect_stdout(printed):
    pendular.view("/tmp")
address = printed.getvalue().strip().replace("localhost", "127.0.0.1")  # a bare system knows no names
cookie = urllib.request.urlopen(address).headers["Set-Cookie"].split(";")[0]
def ask(path):
    return urllib.request.urlopen(urllib.request.Request(address.split("?")[0] + path, headers={"Cookie": cookie})).read()
assert b"main.js" in ask("") and b"webgl2" in ask("main.js")
drivers = [driver["driver"] for driver in json.loads(ask("api/drivers"))]
assert "WetTower" in drivers, drivers
print("view:", len(drivers), "drivers")
END
    inside python3 /tmp/view.py
fi

cat >"$root/tmp/hash.py" <<'END'
import pendular
scene = pendular.Scene()
glass = scene.add_species("HertzianViscoelasticMindlinLiquidBridgeBagheri", density=2500, young_modulus=5e6,
                          poisson_ratio=0.25, restitution_coefficient=0.5, sliding_friction_coefficient=0.4,
                          liquid_bridge_volume=2e-12, contact_angle=0.3, surface_tension=0.072)
scene.add_box(glass, (0, 0, 0), (0.02, 0.02, 0.04))
scene.insert(glass, pendular.even_sizes(1.8e-3, 2e-3), pendular.box((0, 0, 0), (0.02, 0.02, 0.03)), solid_fraction=0.4)
scene.gravity = (0, 0, -9.81)
scene.choose_time_step()
scene.run(0.05)
print(scene.hash())
END
# The hash of a scene of the module, and of a wet bed from its first grain on of a program, where the package has it.
hashes() {
    inside PENDULAR_LEVEL="$1" python3 /tmp/hash.py
    if inside PENDULAR_LEVEL="$1" pendular | grep -q benchmark-scenes; then
        inside PENDULAR_LEVEL="$1" pendular benchmark-scenes --scene wet-bed --particles 300 --steps 100 \
            --states "/tmp/states-$1" | cut -d, -f13
    fi
}
chosen=$(hashes "")
echo "By itself: "$chosen
if [[ ! -d $root/usr/lib/python3/dist-packages/pendular/x86-64-v2 ]]; then exit 0; fi  # the package of one machine
levels=$(inside python3 -c 'from pendular._choose import levels; print(*levels())')
for level in $levels; do
    of_level=$(hashes "$level")
    echo "$level: "$of_level
    if [[ $of_level != "$chosen" ]]; then
        echo "test-package.sh: $level does not have the same bits." >&2
        exit 1
    fi
done
# Each level is its own code, and the best is taken.
maps='import pendular; print([l.split()[-1] for l in open("/proc/self/maps") if "_kernel" in l][0])'
inside python3 -c "$maps" | grep "/${levels%% *}/"
