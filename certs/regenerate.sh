#!/bin/sh
# Makes the certificates in this folder again, and checks them.
set -eu
cd "$(dirname "$0")/.."
cargo build --release
for name in octahedron disulfide dodecagon k33 prism icosahedron-c1; do
    target/release/krawl solve "problems/$name.toml" --cert "certs/$name.krawl" --quiet
    target/release/krawl verify "certs/$name.krawl" "problems/$name.toml" --quiet
    echo "$name: $(wc -c < "certs/$name.krawl") bytes"
done
for edit in reached:40 limit:30; do
    name="plate-${edit%:*}"
    # An edit that ends at a limit has an exit code of its own.
    target/release/krawl edit docs/examples/plate.toml --set "C-D=${edit#*:}" --cert "certs/$name.krawl" --quiet || [ $? = 3 ]
    target/release/krawl verify "certs/$name.krawl" docs/examples/plate.toml --quiet
    echo "$name: $(wc -c < "certs/$name.krawl") bytes"
done
