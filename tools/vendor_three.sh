#!/bin/sh
# Rebuild src/plyfold/draw/static/three.min.js and its licence: the part of three.js that the 3D page uses, as one
# minified ES module. Needs npm. The versions are pinned, so the result is the same on every machine.
set -eu

THREE=0.187.0
ESBUILD=0.28.2
static=$(cd "$(dirname "$0")/../src/plyfold/draw/static" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cd "$work"
npm init --yes >/dev/null
npm install --silent --no-audit --no-fund "three@$THREE" "esbuild@$ESBUILD"

cat >entry.js <<'END'
export {
  AmbientLight, BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, Group, HemisphereLight,
  Mesh, MeshStandardMaterial, NeutralToneMapping, OrthographicCamera, PCFShadowMap, PerspectiveCamera,
  PlaneGeometry, Raycaster, Scene, ShadowMaterial, Vector2, Vector3, WebGLRenderer,
} from "three";
export { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
export { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
export { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
export { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
END

npx esbuild entry.js --bundle --minify --format=esm --target=es2022 --legal-comments=none \
  --banner:js="/* three.js $THREE, MIT licence, see LICENSE-three.txt; made by tools/vendor_three.sh */" \
  --outfile="$static/three.min.js"
cp node_modules/three/LICENSE "$static/LICENSE-three.txt"
