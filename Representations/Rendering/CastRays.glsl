//VTK::System::Dec
//VTK::Output::Dec

// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause

// The rays of a picture. Functions and members are those of the core, where they are explained:
// Ray.h, BrickDistances.h, RaySamples.h, Segment.h, Classification.h, RayLight.h, StructureTint.h,
// MissedImportance.h. Tests compare the pictures with those of the processor.
//
// OpenGlCaster defines, for what a scene needs: LIT, SHADOWED, OVERLAID, MASKED (empty nodes),
// TINTED, SKIPPING (empty bricks), MISSED, BEGINNING and ENDING (depths of pixels), and IN_PARTS
// (processes draw together, and fields are those of a part).

const float pi = 3.14159265358979;

in vec2 texCoord;

// Rays, see ShaderRays
uniform vec2 pictureSize;
uniform vec2 drawnRows; // from the first to behind the last
uniform vec3 frontMiddle;
uniform vec3 frontRight;
uniform vec3 frontUp;
uniform vec3 backMiddle;
uniform vec3 backRight;
uniform vec3 backUp;
uniform vec2 clipDepths;
uniform vec2 clipWeights;
uniform mat3 toRadii;
uniform float stepLength; // [radii]
uniform bool jitters;
uniform vec4 planes[16]; // [index]
uniform int planeCount;
uniform vec3 wholeLastNode;
#ifdef IN_PARTS
uniform vec3 partLow; // see RayPart
uniform vec3 partHigh;
uniform vec3 partFirst;
#endif
#ifdef BEGINNING
uniform sampler2D nearDepth;
#endif
#ifdef ENDING
uniform sampler2D endDepth;
#endif

// Fields
uniform vec3 lastNode;
uniform sampler3D scalars;
uniform float tableLow;
uniform float tableScale;
uniform int tableLast;
uniform samplerBuffer table; // OpticalEntry: two texels
uniform float opaqueBelow;
uniform float depthUnit; // optical depth of a sample at the majorant
uniform float addedUnit; // [majorant]
#ifdef MASKED
uniform sampler3D filledShares;
#endif
#if defined(OVERLAID) || defined(SHADOWED)
uniform vec3 overlayShift; // [nodes]
uniform vec3 overlayScale;
uniform vec3 overlayNodes;
#endif
#ifdef OVERLAID
uniform sampler3D overlay;
#endif
#ifdef LIT
uniform sampler3D gradients;
#endif
#ifdef SHADOWED
uniform sampler3D shadows;
#endif
#ifdef TINTED
uniform usampler3D structures;
uniform samplerBuffer tints;
#endif
#ifdef SKIPPING
uniform usampler3D bricks;
#endif

// Light, see RayLight
uniform vec3 lightOrigin;
uniform float isPoint;
uniform float ambient;
uniform float diffuse;
uniform float anisotropy;
uniform float phaseUnit;
uniform float surface;
uniform float shadowStrength;
uniform float lobeFactor;
uniform float lobePower;

struct Ray
{
  vec3 entry;
  vec3 pace; // Ray::step
  vec3 lightEntry;
  vec3 lightPace;
  vec3 toViewer;
  float end; // Ray::length
  float shift;
  int segments;
  int begin;
};

float DistanceOf(Ray ray, float sampleNumber)
{
  return clamp(sampleNumber - ray.shift, 0.0, ray.end);
}

// ---- Ray.h: the ray of a pixel

float Noise(vec2 pixel)
{
  float inner = fract(0.06711056 * pixel.x + 0.00583715 * pixel.y);
  return fract(52.9829189 * inner);
}

// Returns the share of the way from the front to the back at a depth in clip coordinates.
float ShareAt(float depth)
{
  float behindFront = (depth - clipDepths.x) * clipWeights.y;
  return behindFront / ((clipDepths.y - depth) * clipWeights.x + behindFront);
}

#ifdef IN_PARTS
int FirstBeyond(Ray ray, int axis, float bound)
{
  bool rises = ray.pace[axis] >= 0.0;
  int before = -1;
  int beyond = ray.segments;
  while (beyond - before > 1)
  {
    int segment = (before + beyond) / 2;
    float middle = 0.5 * (DistanceOf(ray, float(segment)) + DistanceOf(ray, float(segment + 1)));
    float position = ray.entry[axis] + middle * ray.pace[axis];
    bool isBeyond = rises ? position >= bound : position < bound;
    before = isBeyond ? before : segment;
    beyond = isBeyond ? segment : beyond;
  }
  return beyond;
}

// Cuts a ray to the nodes that this process owns.
void Cut(inout Ray ray)
{
  int begin = 0;
  int end = ray.segments;
  for (int axis = 0; axis < 3; ++axis)
  {
    bool rises = ray.pace[axis] >= 0.0;
    begin = max(begin, FirstBeyond(ray, axis, rises ? partLow[axis] : partHigh[axis]));
    end = min(end, FirstBeyond(ray, axis, rises ? partHigh[axis] : partLow[axis]));
  }
  ray.entry -= partFirst;
  ray.end = DistanceOf(ray, float(end));
  ray.segments = begin < end ? end : 0;
  ray.begin = begin < end ? begin : 0;
}
#endif

bool MakeRay(float start, float end, out Ray ray)
{
  vec2 pixel = floor(texCoord * pictureSize);
  vec2 clip = 2.0 * (pixel + 0.5) / pictureSize - 1.0;
  vec3 from = frontMiddle + clip.x * frontRight + clip.y * frontUp;
  vec3 way = backMiddle + clip.x * backRight + clip.y * backUp - from;
  float first = ShareAt(-1.0);
  float last = ShareAt(end);
  bool meets = end > start;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (way[axis] != 0.0)
    {
      float perLength = 1.0 / way[axis];
      float one = -from[axis] * perLength;
      float other = (wholeLastNode[axis] - from[axis]) * perLength;
      first = max(first, min(one, other));
      last = min(last, max(one, other));
    }
    else if (from[axis] < 0.0 || from[axis] > wholeLastNode[axis])
    {
      meets = false;
    }
  }
  for (int i = 0; i < planeCount; ++i)
  {
    float at = dot(planes[i], vec4(from, 1.0));
    float along = dot(planes[i].xyz, way);
    if (along != 0.0)
    {
      float crossing = -at / along;
      first = along > 0.0 ? max(first, crossing) : first;
      last = along < 0.0 ? min(last, crossing) : last;
    }
    else if (at < 0.0)
    {
      meets = false;
    }
  }
  float begin = start > -1.0 ? ShareAt(start) : first;
  float entry = max(first, begin);
  vec3 radii = toRadii * way;
  float perWay = 1.0 / length(radii);
  float perStep = stepLength * perWay;
  ray.entry = from + entry * way;
  ray.pace = perStep * way;
  ray.lightEntry = toRadii * (ray.entry - 0.5 * wholeLastNode);
  ray.lightPace = perStep * radii;
  ray.toViewer = -perWay * radii;
  ray.end = (last - entry) / perStep;
  ray.shift = jitters ? Noise(pixel) : 0.0;
  if (first < begin)
  {
    ray.shift = fract((begin - first) / perStep + ray.shift);
  }
  ray.segments = int(ceil(ray.end + ray.shift));
  ray.begin = 0;
  meets = meets && last > entry && ray.segments > 0;
#ifdef IN_PARTS
  Cut(ray);
#endif
  return meets && ray.segments > 0;
}

Ray Reversed(Ray ray)
{
  Ray back = ray;
  back.entry = ray.entry + ray.end * ray.pace;
  back.pace = -ray.pace;
  back.shift = max(float(ray.segments) - ray.shift - ray.end, 0.0);
  return back;
}

// ---- BrickDistances.h

#ifdef SKIPPING
const int brickSize = 4;

ivec3 BrickAt(vec3 position)
{
  return ivec3(clamp(position, vec3(0.0), lastNode - 1.0)) / brickSize;
}

int EmptyAround(usampler3D distances, ivec3 brick)
{
  return int(texelFetch(distances, brick, 0).r);
}

int SkipEmpty(usampler3D distances, Ray ray, int k)
{
  vec3 perPace = vec3(1e30);
  for (int axis = 0; axis < 3; ++axis)
  {
    perPace[axis] = abs(ray.pace[axis]) > 1e-12 ? 1.0 / ray.pace[axis] : 1e30;
  }
  vec3 position = ray.entry + DistanceOf(ray, float(k)) * ray.pace;
  ivec3 brick = BrickAt(position);
  int around = EmptyAround(distances, brick);
  while (around > 0 && k < ray.segments)
  {
    vec3 side = mix(vec3(brick - around + 1), vec3(brick + around), greaterThan(perPace, vec3(0.0)));
    vec3 reach = (side * float(brickSize) - position) * perPace;
    int inside = int(max(min(min(reach.x, reach.y), min(reach.z, 1e6)), 0.0));
    int last = k + inside;
    position = ray.entry + DistanceOf(ray, float(last + 1)) * ray.pace;
    brick = BrickAt(position);
    around = EmptyAround(distances, brick);
    k = around > 0 ? last + 1 : last;
  }
  return min(k, ray.segments);
}
#endif

// ---- Classification.h

struct OpticalEntry
{
  vec4 value;    // extinction [majorant], red, green, blue
  vec4 integral;
};

float TablePosition(vec3 position)
{
  float scalar = textureLod(scalars, (position + 0.5) / (lastNode + 1.0), 0.0).r;
  return (scalar - tableLow) * tableScale;
}

OpticalEntry Look(float position)
{
  float inside = clamp(position, 0.0, float(tableLast));
  int before = min(int(inside), tableLast - 1);
  float share = inside - float(before);
  OpticalEntry there;
  there.value = mix(texelFetch(table, 2 * before), texelFetch(table, 2 * before + 2), share);
  there.integral = mix(texelFetch(table, 2 * before + 1), texelFetch(table, 2 * before + 3), share);
  float weight = there.value.x + 1e-3;
  there.integral += (position - inside) * vec4(there.value.x, weight * there.value.yzw);
  return there;
}

// ---- RaySamples.h: a sample, and the segment in front of it

struct Sample
{
  float distance; // from the entry [samples]
  float position; // in the table
  OpticalEntry optics;
  float filled;
  float kept;
  float added; // [addedUnit]
};

struct Segment
{
  float base;  // optical depth with the transfer function's extinction
  float depth; // with the one that is shown
  vec3 color;
};

#if defined(OVERLAID) || defined(SHADOWED)
vec3 InOverlay(vec3 position)
{
  return ((position + overlayShift) * overlayScale + 0.5) / overlayNodes;
}
#endif

Sample SampleAt(Ray ray, int k)
{
  Sample here;
  here.distance = DistanceOf(ray, float(k));
  vec3 position = ray.entry + here.distance * ray.pace;
  here.position = TablePosition(position);
  here.optics = Look(here.position);
  here.filled = 1.0;
  here.kept = 1.0;
  here.added = 0.0;
#ifdef MASKED
  here.filled = textureLod(filledShares, (position + 0.5) / (lastNode + 1.0), 0.0).r;
#endif
#ifdef OVERLAID
  vec2 change = textureLod(overlay, InOverlay(position), 0.0).rg;
  here.kept = change.r;
  here.added = change.g;
#endif
  return here;
}

Segment SegmentOf(Sample front, Sample rear)
{
  float distance = rear.position - front.position;
  vec4 ends = front.optics.value + rear.optics.value;
  vec4 mean = 0.5 * ends;
  if (abs(distance) > 4.0)
  {
    mean = (rear.optics.integral - front.optics.integral) / distance;
    mean.yzw /= mean.x + 1e-3;
  }
  float filled = 0.5 * (front.filled + rear.filled);
  float kept = 0.5 * (front.kept + rear.kept);
  float added = 0.5 * addedUnit * (front.added + rear.added);
  float extinction = min(mean.x * filled * kept + added, max(addedUnit, 1.0));
  float unit = depthUnit * (rear.distance - front.distance);
  return Segment(mean.x * filled * unit, extinction * unit, mean.yzw);
}

bool LastIsFilled(Ray ray, Sample last)
{
#ifdef SKIPPING
  return EmptyAround(bricks, BrickAt(ray.entry + last.distance * ray.pace)) == 0;
#else
  return false;
#endif
}

// ---- RayLight.h

#ifdef LIT
float Lobe(float x)
{
  return lobeFactor * pow(max(x, 1e-30), lobePower);
}

float SurfaceScattering(float lobe)
{
  return 0.75 / pi + 0.25 * lobe;
}

float HenyeyGreenstein(float cosine)
{
  float square = anisotropy * anisotropy;
  float base = 1.0 + square - 2.0 * anisotropy * cosine;
  return (1.0 - square) / (4.0 * pi * base * sqrt(base));
}

struct LightHere
{
  float scattered;
  float arriving;
};

LightHere LightAt(Ray ray, float distance)
{
  vec3 travel = isPoint * (ray.lightEntry + distance * ray.lightPace) - lightOrigin;
  travel *= inversesqrt(dot(travel, travel) + 1e-30);
  float cosine = dot(travel, ray.toViewer);
  vec3 halfway = travel - ray.toViewer;
  float towards = max(-cosine, 0.5);
  float ofFacing = towards * SurfaceScattering(Lobe(sqrt(0.5 + 0.5 * towards)));
  vec3 position = ray.entry + distance * ray.pace;
  vec3 gradient = textureLod(gradients, (position + 0.5) / (lastNode + 1.0), 0.0).xyz;
  float squared = dot(gradient, gradient) + 1e-20;
  float across = dot(halfway, gradient) / sqrt(squared * (dot(halfway, halfway) + 1e-20));
  float facing = max(dot(travel, gradient), 0.0);
  float reflected = surface * SurfaceScattering(Lobe(max(across, 0.0))) * facing / ofFacing;
  LightHere here;
  here.scattered =
    (HenyeyGreenstein(cosine) * phaseUnit + reflected) / (1.0 + surface * sqrt(squared));
  here.arriving = 1.0;
#ifdef SHADOWED
  here.arriving = textureLod(shadows, InOverlay(position), 0.0).r;
#endif
  return here;
}

float Sent(float scattered, float arriving)
{
  float lit = 1.0 - shadowStrength * (1.0 - arriving);
  float lacking = max(1.0 - lit * scattered, 0.0);
  return ambient + diffuse * (1.0 - lacking * sqrt(lacking));
}

float WeightOfRear(float depth, float passed)
{
  return depth > 0.05 ? 1.0 / (depth + 1e-30) - passed / (1.0 - passed + 1e-30)
                      : 0.5 - depth / 12.0;
}
#endif

// ---- StructureTint.h

#ifdef TINTED
uint RowAt(vec3 position)
{
  vec3 inside = clamp(position, vec3(0.0), lastNode);
  ivec3 cell = ivec3(min(inside, lastNode - 1.0));
  vec3 share = inside - vec3(cell);
  uint rows[8];
  float weights[8];
  bool areSame = true;
  for (int node = 0; node < 8; ++node)
  {
    ivec3 far = ivec3(node & 1, node >> 1 & 1, node >> 2);
    rows[node] = texelFetch(structures, cell + far, 0).r;
    vec3 weight = mix(1.0 - share, share, vec3(far));
    weights[node] = weight.x * weight.y * weight.z;
    areSame = areSame && rows[node] == rows[0];
  }
  uint best = rows[0];
  float most = 0.0;
  for (int node = 0; node < 8 && !areSame; ++node)
  {
    float sum = 0.0;
    for (int other = 0; other < 8; ++other)
    {
      sum += rows[other] == rows[node] ? weights[other] : 0.0;
    }
    best = sum > most ? rows[node] : best;
    most = max(sum, most);
  }
  return best;
}
#endif

// ---- TraceRay.h

// Returns red, green, blue and the transmittance of a ray.
vec4 TraceRay(Ray ray)
{
  vec4 received = vec4(0.0, 0.0, 0.0, 1.0);
  Sample front;
  Sample rear;
#ifdef LIT
  LightHere lightFront;
  LightHere lightRear;
  int litTo = -1;
#endif
  int last = -1;
  bool goOn = false;
  for (int k = ray.begin; k < ray.segments && received.a > opaqueBelow; k = last)
  {
#ifdef SKIPPING
    if (!goOn)
    {
      k = SkipEmpty(bricks, ray, k);
      if (k >= ray.segments)
      {
        break;
      }
    }
#endif
    bool begins = last != k;
    last = begins ? k : k + 1;
    front = rear;
    rear = SampleAt(ray, last);
    goOn = LastIsFilled(ray, rear);
    if (begins)
    {
      continue; // a segment without length
    }
    Segment segment = SegmentOf(front, rear);
    if (!(segment.depth > 0.0))
    {
      continue;
    }
    float passed = exp(-segment.depth);
    float sent = 1.0 - passed;
#ifdef LIT
    lightFront = lightRear;
    if (litTo != last - 1)
    {
      lightFront = LightAt(ray, front.distance);
    }
    lightRear = LightAt(ray, rear.distance);
    litTo = last;
    float weight = WeightOfRear(segment.depth, passed);
    sent *= Sent(mix(lightFront.scattered, lightRear.scattered, weight),
      mix(lightFront.arriving, lightRear.arriving, weight));
#endif
    vec3 color = segment.color;
#ifdef TINTED
    float middle = 0.5 * (front.distance + rear.distance);
    vec4 tint = texelFetch(tints, int(RowAt(ray.entry + middle * ray.pace)));
    color = (1.0 - tint.x) * color + tint.yzw;
#endif
    received.rgb += received.a * sent * color;
    received.a *= passed;
  }
  return received;
}

// ---- Segment.h: Pixel::Shown

vec4 Shown(vec4 received)
{
  float alpha = 1.0 - received.a;
  float brightest = max(received.r, max(received.g, received.b));
  float tone = brightest > alpha ? alpha / brightest : 1.0;
  return vec4(received.rgb * tone, alpha);
}

// ---- MissedImportance.h, TraceMissed.h

#ifdef MISSED
uniform vec3 missedColor;
uniform sampler3D importances;
#ifdef SKIPPING
uniform usampler3D unimportant;
uniform usampler3D bareBricks;
#endif
#ifdef MISSED_ENDING
uniform sampler2D missedDepth;
#endif

struct RayImportance
{
  float shown;
  float possible;
  float removed;
  float painted;
};

float HiddenBy(RayImportance gathered)
{
  return max(gathered.possible - gathered.shown, 0.0);
}

void AddInFront(inout RayImportance gathered, float importance, float base, float depth)
{
  float stopped = 1.0 - exp(-depth);
  float baseStopped = 1.0 - exp(-base);
  float passed = 1.0 - stopped;
  float meanPassed = depth > 1e-4 ? stopped / depth : 1.0 - 0.5 * depth;
  float keptShare = base < depth ? base / depth : 1.0;
  float lost = max(base - depth, 0.0);
  float withIt = baseStopped * importance + (1.0 - baseStopped) * gathered.possible;
  float hiddenBehind = HiddenBy(gathered);
  gathered.shown = keptShare * stopped * importance + passed * gathered.shown;
  gathered.possible = max(withIt, gathered.possible);
  gathered.removed = importance * lost * meanPassed + passed * gathered.removed;
  float thicker = max(base, depth);
  float there = thicker > 0.0 ? min(base, depth) / thicker : 0.0;
  float lacking = gathered.possible > 0.0 ? 1.0 - importance / gathered.possible : 1.0;
  float less = max(lacking, 0.0);
  float covering = there * (1.0 - less * less);
  float hidden = HiddenBy(gathered);
  float grown = max(hidden - hiddenBehind, 0.0);
  float left = (1.0 - covering * stopped) * gathered.painted;
  gathered.painted = min(left + (1.0 - covering) * grown, hidden);
}

float ImportanceAt(Ray ray, float distance)
{
  vec3 position = ray.entry + distance * ray.pace;
  return textureLod(importances, (position + 0.5) / (lastNode + 1.0), 0.0).r;
}

// Returns the share of the pixel that misses something.
float TraceMissed(Ray ray)
{
  Ray back = Reversed(ray);
  RayImportance gathered = RayImportance(0.0, 0.0, 0.0, 0.0);
  Sample front;
  Sample rear;
  float importanceFront = 0.0;
  float importanceRear = 0.0;
  int last = -1;
  bool lastFilled = false;
  for (int k = 0; k < back.segments; k = last)
  {
    bool isEmpty = gathered.possible == 0.0 && gathered.shown == 0.0 && gathered.removed == 0.0;
#ifdef SKIPPING
    if (!(last == k && !isEmpty && lastFilled))
    {
      k = isEmpty ? SkipEmpty(unimportant, back, k) : SkipEmpty(bareBricks, back, k);
      if (k >= back.segments)
      {
        break;
      }
    }
#endif
    bool begins = last != k;
    last = begins ? k : k + 1;
    front = rear;
    importanceFront = importanceRear;
    rear = SampleAt(back, last);
    importanceRear = ImportanceAt(back, rear.distance);
#ifdef SKIPPING
    lastFilled =
      EmptyAround(bareBricks, BrickAt(back.entry + rear.distance * back.pace)) == 0;
#endif
    if (!begins)
    {
      Segment segment = SegmentOf(front, rear);
      AddInFront(
        gathered, 0.5 * (importanceFront + importanceRear), segment.base, segment.depth);
    }
  }
  return 1.0 - (1.0 - gathered.painted) * exp(-gathered.removed);
}

vec4 PaintedOver(vec4 pixel, float missed)
{
  float opacity = 0.7 * missed * missed * (3.0 - 2.0 * missed);
  return mix(pixel, vec4(missedColor, 1.0), opacity);
}
#endif

void main()
{
  float start = -1.0;
  float end = 1.0;
  ivec2 pixel = ivec2(texCoord * pictureSize);
#ifdef BEGINNING
  start = texelFetch(nearDepth, pixel, 0).r;
#endif
#ifdef ENDING
  end = texelFetch(endDepth, pixel, 0).r;
#endif
  vec4 received = vec4(0.0, 0.0, 0.0, 1.0);
  Ray ray;
  ray.begin = 0;
  bool isDrawn = float(pixel.y) >= drawnRows.x && float(pixel.y) < drawnRows.y;
  if (isDrawn && MakeRay(start, end, ray))
  {
    received = TraceRay(ray);
  }
#ifdef IN_PARTS
  gl_FragData[0] = received;
  gl_FragData[1] = vec4(float(ray.begin));
#else
  vec4 color = Shown(received);
#ifdef MISSED
#ifdef MISSED_ENDING
  start = -1.0;
  end = texelFetch(missedDepth, pixel, 0).r;
#endif
  if (isDrawn && MakeRay(start, end, ray))
  {
    color = PaintedOver(color, TraceMissed(ray));
  }
#endif
  gl_FragData[0] = color;
#endif
}
