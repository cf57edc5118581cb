// The viewer's page: what is chosen, and where the hand is. three.js draws; all lengths are metres.
"use strict";

const content = JSON.parse(document.getElementById("content").textContent);
const field = (id) => document.getElementById(id);
const ANY = "any";
const PART_COLOURS = ["#4e79a7", "#f28e2b", "#59a14f", "#e15759", "#b07aa1", "#edc948", "#76b7b2", "#ff9da7", "#9c755f"];
// From never touched to touched by most people.
const HEAT = [[0, [0.82, 0.84, 0.86]], [0.25, [0.98, 0.85, 0.45]], [0.6, [0.93, 0.42, 0.13]], [1, [0.55, 0.02, 0.1]]];
const FACT_NAMES = {
  Error: "energy", reason: "physics test", shape: "type by the rule", branch: "why this type", margin: "margin",
  penetration_m: "penetration", tries: "tries",
};
const METRES_PER_NEWTON = 0.002; // an arrow of 1 cm is 5 N, as page.html says
const LONGEST_ARROW = 0.1;
const SECONDS = 2.5; // of a whole closing motion

const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(35, 1, 0.01, 20);
const controls = new THREE.OrbitControls(camera, renderer.domElement);
const lamp = new THREE.DirectionalLight("#ffffff", 2.2);
const objectGroup = new THREE.Group();
const handGroup = new THREE.Group();
const contactGroup = new THREE.Group();
const loaded = {};
let grasps = [];
let shown = null;
let playing = null;
let changed = true; // since the last picture
let turned = false; // by the user, since the page chose where to look from

// Arrays of a stored blob by their [offset, type, length].
async function unpack(id) {
  const bytes = Uint8Array.from(atob(field(id).textContent), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  const buffer = await new Response(stream).arrayBuffer();
  const kinds = { uint8: Uint8Array, uint16: Uint16Array, uint32: Uint32Array };
  return ([offset, kind, length]) => new kinds[kind](buffer, offset, length);
}

function geometry(mesh, array) {
  const steps = array(mesh.vertices);
  const points = new Float32Array(steps.length);
  for (let i = 0; i < steps.length; i++) points[i] = mesh.low[i % 3] + (steps[i] / 65535) * mesh.extent[i % 3];
  const made = new THREE.BufferGeometry();
  made.setAttribute("position", new THREE.BufferAttribute(points, 3));
  made.setIndex(new THREE.BufferAttribute(array(mesh.faces), 1));
  made.computeVertexNormals();
  return made;
}

function heat(value) {
  const upper = HEAT.findIndex(([at]) => at >= value);
  if (upper <= 0) return HEAT[0][1];
  const [[low, dark], [high, bright]] = [HEAT[upper - 1], HEAT[upper]];
  const share = (value - low) / (high - low);
  return dark.map((from, i) => from + share * (bright[i] - from));
}

async function loadHand() {
  const array = await unpack("hand");
  const frames = content.hand.links.map((link) => {
    const frame = new THREE.Group();
    for (const { colour, mesh } of link.visuals) {
      const look = new THREE.MeshStandardMaterial({
        color: new THREE.Color(...colour), roughness: 0.55, metalness: 0.2, side: THREE.DoubleSide,
      });
      // Facets as they are: links are made of flat and cylindrical pieces.
      look.flatShading = true;
      frame.add(new THREE.Mesh(geometry(mesh, array), look));
    }
    return frame;
  });
  handGroup.add(frames[0]);
  content.hand.joints.forEach((joint, i) => {
    const rest = new THREE.Group();
    rest.matrixAutoUpdate = false;
    rest.matrix.set(...joint.rest);
    rest.add(frames[i + 1]);
    frames[joint.parent].add(rest);
  });
  handGroup.matrixAutoUpdate = false;
  return frames;
}

async function loadObject(name) {
  if (loaded[name]) return loaded[name];
  const { parts, surface } = content.objects[name];
  const array = await unpack(`object ${name}`);
  const group = new THREE.Group();
  const meshes = parts.map((part) => {
    const mesh = new THREE.Mesh(geometry(part.mesh, array), new THREE.MeshStandardMaterial({ side: THREE.DoubleSide }));
    group.add(mesh);
    return mesh;
  });
  let touched = null;
  if (surface) {
    touched = new THREE.Mesh(geometry(surface, array), new THREE.MeshStandardMaterial({ vertexColors: true, roughness: 0.8, side: THREE.DoubleSide }));
    group.add(touched);
  }
  return (loaded[name] = { group, meshes, touched, array });
}

function paint({ meshes, touched, array }) {
  changed = true;
  const { parts, maps } = content.objects[shown.object];
  const how = field("colours").value;
  const mapped = how === "contact map" && touched && maps[shown.task];
  meshes.forEach((mesh, i) => {
    const part = parts[i];
    mesh.visible = !mapped;
    const named = how === "parts";
    mesh.material.color = named ? new THREE.Color(PART_COLOURS[i % PART_COLOURS.length]) : new THREE.Color(...part.colour);
    mesh.material.metalness = named ? 0 : part.metallic * 0.5; // without surroundings to mirror, metal is black
    mesh.material.roughness = named ? 0.8 : part.roughness;
  });
  // One scale for all tasks of an object.
  const top = Object.values(maps).reduce((most, map) => array(map).reduce((a, b) => Math.max(a, b), most), 1);
  if (touched) touched.visible = Boolean(mapped);
  if (mapped) {
    const colours = new Float32Array([...array(maps[shown.task])].flatMap((level) => heat(level / top)));
    touched.geometry.setAttribute("color", new THREE.BufferAttribute(colours, 3));
  }
  const legend = field("legend");
  legend.replaceChildren();
  if (mapped) {
    const stops = HEAT.map(([at, rgb]) => `rgb(${rgb.map((v) => 255 * v ** (1 / 2.2))}) ${100 * at}%`);
    legend.innerHTML = `share of people who touch it<div class="scale" style="background:linear-gradient(90deg,${stops})"></div>0 % <span style="float:right">${Math.round((100 * top) / 255)} %</span>`;
  } else if (how === "parts") {
    parts.forEach((part, i) => {
      const row = document.createElement("div");
      const key = document.createElement("span");
      key.className = "key";
      key.style.background = PART_COLOURS[i % PART_COLOURS.length];
      row.append(key, part.role && part.role !== part.name ? `${part.name} (${part.role})` : part.name);
      legend.append(row);
    });
  }
}

// Place the hand at a moment from 0 (open, drawn back) to 1 (the grasp).
function pose(moment) {
  changed = true;
  const { retreat, joints } = shown;
  const place = moment * (retreat.length - 1);
  const before = Math.min(Math.floor(place), retreat.length - 2);
  const share = place - before;
  const between = (a, b) => a + share * (b - a);
  const back = between(retreat[before], retreat[before + 1]);
  const [x, y, z] = shown.pose;
  handGroup.matrix.set(...x, ...y, ...z, 0, 0, 0, 1);
  handGroup.matrix.multiply(new THREE.Matrix4().makeTranslation(0, 0, -back));
  content.hand.joints.forEach((joint, i) => {
    const value = between(joints[before][i], joints[before + 1][i]);
    if (joint.prismatic) frames[i + 1].position.z = value;
    else frames[i + 1].rotation.z = value;
  });
  contactGroup.visible = field("contacts-shown").checked && moment > 0.999;
  field("moment").value = moment;
}

function drawContacts() {
  contactGroup.clear();
  shown.points.forEach((point, i) => {
    const at = new THREE.Vector3(...point);
    const ball = new THREE.Mesh(new THREE.SphereGeometry(0.0025, 16, 12), new THREE.MeshBasicMaterial({ color: "#00b050", depthTest: false, transparent: true }));
    ball.position.copy(at);
    ball.renderOrder = 1;
    contactGroup.add(ball);
    if (!shown.forces) return;
    const force = new THREE.Vector3(...shown.forces[i]);
    const length = Math.min(METRES_PER_NEWTON * force.length(), LONGEST_ARROW);
    if (length < 0.001) return;
    const from = at.clone().addScaledVector(force.normalize(), -length);
    const arrow = new THREE.ArrowHelper(force, from, length, "#0057d9", 0.6 * length, Math.min(0.3 * length, 0.007));
    for (const part of [arrow.line, arrow.cone]) {
      part.material.depthTest = false;
      part.material.transparent = true;
      part.renderOrder = 2;
    }
    contactGroup.add(arrow);
  });
}

function tell() {
  const rows = [["object", shown.object], ["task", shown.task], ["grasp type", shown.type], ["rank", shown.rank], ["session", shown.session]];
  for (const [key, value] of Object.entries(shown.facts)) {
    let text = value;
    if (key === "penetration_m") text = `${(1000 * value).toFixed(2)} mm`;
    else if (key === "Error" || key === "margin") text = Number(value).toFixed(3);
    rows.push([FACT_NAMES[key], text]);
  }
  const pressed = {};
  shown.links.forEach((name, i) => (pressed[name] ??= []).push(shown.forces ? Math.hypot(...shown.forces[i]) : 0));
  const links = Object.entries(pressed).map(([name, forces]) => {
    const sum = forces.reduce((a, b) => a + b);
    const where = forces.length > 1 ? ` at ${forces.length} points` : "";
    return `${name}${shown.forces ? ` ${sum.toFixed(1)} N` : ""}${where}`;
  });
  rows.push(["contacts", links.join(", ") || "none recorded"]);
  field("facts").replaceChildren(...rows.map((cells) => {
    const row = document.createElement("tr");
    row.append(...cells.map((cell) => Object.assign(document.createElement("td"), { textContent: cell })));
    return row;
  }));
}

// Look at object and hand from a side on which the hand hides little.
function aim() {
  changed = true;
  turned = false;
  const box = new THREE.Box3().setFromObject(objectGroup);
  if (shown.pose) box.union(new THREE.Box3().setFromObject(handGroup));
  const centre = box.getCenter(new THREE.Vector3());
  const reach = 0.5 * box.getSize(new THREE.Vector3()).length() / Math.tan((camera.fov * Math.PI) / 360);
  const side = shown.pose ? new THREE.Vector3(shown.pose[0][0], shown.pose[1][0], shown.pose[2][0]).multiplyScalar(0.8) : new THREE.Vector3();
  side.add(new THREE.Vector3(0.35, -0.6, 0.6));
  if (shown.pose) {
    const approach = new THREE.Vector3(shown.pose[0][2], shown.pose[1][2], shown.pose[2][2]);
    side.addScaledVector(approach, Math.max(0, 0.2 - side.dot(approach))); // not from behind the hand
  }
  side.normalize();
  camera.position.copy(centre).addScaledVector(side, reach * Math.max(1, 1 / camera.aspect));
  controls.target.copy(centre);
  controls.update();
}

// An object that nobody has grasped yet: its parts, and where people touch it for a task.
async function showObject(object, task) {
  const other = !shown || shown.object !== object;
  shown = { object, task };
  const found = await loadObject(object);
  objectGroup.clear();
  objectGroup.add(found.group);
  handGroup.visible = contactGroup.visible = false;
  paint(found);
  scene.updateMatrixWorld(true);
  if (other) aim();
  document.body.dataset.shown = `${object} ${task}`;
}

async function show(grasp) {
  const other = !shown || shown.object !== grasp.object;
  shown = grasp;
  playing = null;
  const object = await loadObject(grasp.object);
  if (shown !== grasp) return;
  objectGroup.clear();
  objectGroup.add(object.group);
  paint(object);
  handGroup.visible = field("hand-shown").checked;
  drawContacts();
  pose(1);
  tell();
  const place = grasps.indexOf(grasp);
  field("place").textContent = `${place + 1} of ${grasps.length}`;
  field("grasp").value = place;
  scene.updateMatrixWorld(true);
  if (other || !turned) aim();
  document.body.dataset.shown = `${grasp.object} ${grasp.task} ${grasp.session}`;
}

function fill(id, values, kept) {
  const box = field(id);
  box.replaceChildren(...values.map((value) => new Option(value, value)));
  box.value = values.includes(kept) ? kept : values[0];
}

const known = (list, key) => [...new Set(list.map(key))];
const chosen = (id) => field(id).value;
const outcome = (grasp) => grasp.facts.reason ?? "unknown";

// Every list offers what the lists above it leave.
function choose(kept) {
  fill("object", Object.keys(content.objects), chosen("object"));
  const ofObject = content.grasps.filter((grasp) => grasp.object === chosen("object"));
  const { surface, maps } = content.objects[chosen("object")];
  document.body.classList.toggle("bare", !ofObject.length);
  fill("colours", ["materials", "parts", ...(surface ? ["contact map"] : [])], chosen("colours") || (ofObject.length ? "materials" : "parts"));
  if (!ofObject.length) {
    fill("task", Object.keys(maps), chosen("task"));
    return showObject(chosen("object"), chosen("task"));
  }
  fill("task", [ANY, ...known(ofObject, (grasp) => grasp.task)], chosen("task"));
  const ofTask = ofObject.filter((grasp) => [ANY, grasp.task].includes(chosen("task")));
  fill("type", [ANY, ...known(ofTask, (grasp) => grasp.type).sort()], chosen("type"));
  const ofType = ofTask.filter((grasp) => [ANY, grasp.type].includes(chosen("type")));
  fill("reason", [ANY, ...known(ofType, outcome)], kept ? chosen("reason") : "valid");
  grasps = ofType.filter((grasp) => [ANY, outcome(grasp)].includes(chosen("reason")));
  grasps.sort((a, b) => a.task.localeCompare(b.task) || a.rank - b.rank);
  field("grasp").replaceChildren(...grasps.map((grasp, i) => new Option(`${grasp.task}, rank ${grasp.rank}: ${grasp.type}`, i)));
  return show(grasps.includes(kept) ? kept : grasps[0]);
}

const step = (by) => show(grasps[(grasps.indexOf(shown) + by + grasps.length) % grasps.length]);

function resize() {
  changed = true;
  renderer.setPixelRatio(window.devicePixelRatio);
  renderer.setSize(window.innerWidth, window.innerHeight);
  camera.aspect = window.innerWidth / window.innerHeight;
  // The panel covers the left: the middle is that of what is left.
  const covered = Math.min(352, window.innerWidth / 3);
  camera.setViewOffset(window.innerWidth, window.innerHeight, -covered / 2, 0, window.innerWidth, window.innerHeight);
  camera.updateProjectionMatrix();
}

function draw(now) {
  if (playing !== null) {
    const moment = Math.min((now - playing) / 1000 / SECONDS, 1);
    pose(Math.max(moment, 0));
    if (moment === 1) playing = null;
  }
  // A page that nobody touches draws nothing.
  if (controls.update() || changed) {
    changed = false;
    lamp.position.copy(camera.position);
    renderer.render(scene, camera);
  }
  requestAnimationFrame(draw);
}

let frames = [];
async function start() {
  scene.background = new THREE.Color("#eef1f5");
  camera.up.set(0, 0, 1);
  scene.add(new THREE.HemisphereLight("#ffffff", "#8d949e", 1.6), lamp, objectGroup, handGroup, contactGroup);
  document.body.prepend(renderer.domElement);
  controls.addEventListener("start", () => (turned = true));
  controls.enableDamping = true;
  controls.dampingFactor = 0.2;
  window.addEventListener("resize", resize);
  resize();
  for (const id of ["object", "task", "type", "reason"]) field(id).addEventListener("change", () => choose(shown));
  field("grasp").addEventListener("change", () => show(grasps[field("grasp").value]));
  field("previous").addEventListener("click", () => step(-1));
  field("next").addEventListener("click", () => step(1));
  field("colours").addEventListener("change", () => paint(loaded[shown.object]));
  field("hand-shown").addEventListener("change", () => {
    handGroup.visible = field("hand-shown").checked;
    changed = true;
  });
  field("contacts-shown").addEventListener("change", () => pose(Number(field("moment").value)));
  field("play").addEventListener("click", () => (playing = performance.now()));
  field("moment").addEventListener("input", () => {
    playing = null;
    pose(Number(field("moment").value));
  });
  if (content.hand) frames = await loadHand();
  await choose(null);
  requestAnimationFrame(draw);
}

start();
