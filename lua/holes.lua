-- Holes that run through parts one behind the other: where bolts go.
local native = ...
local holes = {}

local function sub(a, b) return { a[1] - b[1], a[2] - b[2], a[3] - b[3] } end
local function dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end
local function along(a, t, u) return { a[1] + t * u[1], a[2] + t * u[2], a[3] + t * u[3] } end
local function unit(a)
  local length = math.sqrt(dot(a, a))
  return { a[1] / length, a[2] / length, a[3] / length }
end

-- Components along the axes of a frame; nil: the deck's.
function holes.along_axes(frame, v)
  if not frame then return v end
  return { dot(v, frame.x), dot(v, frame.y), dot(v, frame.z) }
end

local function name_of(part) return (select(3, native.kind(part))) end
local function in_mm(x) return ("%.4g mm"):format(x * 1e3) end
local function micrometres(x)
  local whole = math.floor(x * 1e6 + 0.5)
  return whole == 0 and 0 or whole
end
local function at_mm(x) return ("(%.7g, %.7g, %.7g) mm"):format(micrometres(x[1]) / 1e3, micrometres(x[2]) / 1e3, micrometres(x[3]) / 1e3) end

local parallel = math.cos(2 * math.pi / 180)
-- Of the diameter of the thread: axes from each other, and parts along the axis, where facets of bent faces pass into
-- each other or stay apart.
local beside, apart = 0.1, 0.1

-- Where `hole` lies along the line through `from` along `u`, m: its lower and upper end; nil: not on that line.
local function range_on(hole, from, u, diameter)
  local axis = unit(sub(hole.high, hole.low))
  if math.abs(dot(axis, u)) < parallel then return nil end
  local to_low, to_high = sub(hole.low, from), sub(hole.high, from)
  local low, high = dot(to_low, u), dot(to_high, u)
  local off = sub(to_low, along({ 0, 0, 0 }, low, u))
  if dot(off, off) > (beside * diameter) ^ 2 then return nil end
  return math.min(low, high), math.max(low, high)
end

-- The holes of other parts that go on from `first`, of the first part. Answers the chain: head (m), direction towards
-- it, grip (m), the parts in turn; or nothing and what the nearest hole on the same line misses.
local function chain_from(first, all, diameter)
  local u, from = unit(sub(first.high, first.low)), first.low
  local low, high = range_on(first, from, u, diameter)
  local chain, used, near_by = { first }, { [first] = true }, nil
  local below, above = 0, 0
  local found = true
  while found do
    found = false
    for _, hole in ipairs(all) do
      local from_low, to_high = nil, nil
      if not used[hole] and hole.part ~= first.part then from_low, to_high = range_on(hole, from, u, diameter) end
      if from_low then
        local gap_above, gap_below = from_low - high, low - to_high
        if math.abs(gap_above) <= apart * diameter then
          high, above, found = to_high, above + 1, true
        elseif math.abs(gap_below) <= apart * diameter then
          low, below, found = from_low, below + 1, true
        elseif not near_by or math.max(gap_above, gap_below) < near_by.gap then
          near_by = { gap = math.max(gap_above, gap_below), hole = hole }
        end
        if found then
          used[hole], chain[#chain + 1] = true, hole
          break
        end
      end
    end
  end
  return { low = along(from, low, u), high = along(from, high, u), u = u, grip = high - low, holes = chain, above = above, below = below,
           near_by = near_by }
end

local function list_of(found, parts)
  local texts, count = {}, {}
  for _, hole in ipairs(found) do
    local text = ("'%s' %s"):format(name_of(parts[hole.part]), in_mm(2 * hole.radius))
    if not count[text] then texts[#texts + 1] = text end
    count[text] = (count[text] or 0) + 1
  end
  for i, text in ipairs(texts) do texts[i] = count[text] > 1 and ("%s (%d)"):format(text, count[text]) or text end
  return #texts > 0 and "holes all around have the diameters: " .. table.concat(texts, ", ") or "no part has a round hole that ends in planes"
end

-- Refuses parts that no chain passes: a bolt would stand in them.
local function check_all_are_passed(chains, parts, fail)
  local is_passed = {}
  for _, chain in ipairs(chains) do
    for _, hole in ipairs(chain.holes) do is_passed[hole.part] = true end
  end
  for i, part in ipairs(parts) do
    if not is_passed[i] then
      local nearest
      for _, chain in ipairs(chains) do
        local near_by = chain.near_by
        if near_by and near_by.hole.part == i and (not nearest or near_by.gap < nearest) then nearest = near_by.gap end
      end
      fail(("no bolt passes through '%s', one of 'parts'"):format(name_of(part)), nearest
        and ("its hole lies on the axis of others, %s %s along it"):format(in_mm(math.abs(nearest)), nearest < 0 and "within them" or "apart from them")
        or "none of its holes on that axis fits the thread: omit the part, or give 'radius'")
    end
  end
end

-- given: parts, the first under the head; radius (m) or nil; head: direction, or nil; where: a function of the hole's
-- end at the head, or nil. diameter: of the thread, m. Answers a list of { head, towards, grip, holes }.
function holes.through(given, diameter, path, line)
  local parts, all = given.parts, native.holes(given.parts)
  local function fail(text, hint) native.fail(line, path .. ": " .. text .. (hint and "\n    " .. hint or "")) end
  local fitting = {}
  for _, hole in ipairs(all) do
    local d = 2 * hole.radius
    local fits = d > 0.999 * diameter and d < 1.3 * diameter
    if given.radius then fits = math.abs(hole.radius - given.radius) < 0.02 * given.radius end
    if fits then fitting[#fitting + 1] = hole end
  end
  local which = given.radius and ("of %s diameter"):format(in_mm(2 * given.radius)) or ("for %s (diameter %s to %s)"):format(given.size, in_mm(diameter), in_mm(1.3 * diameter))
  local chains, left, n_elsewhere = {}, nil, 0
  for _, hole in ipairs(fitting) do
    if hole.part == 1 then
      local chain = chain_from(hole, fitting, diameter)
      if chain.above > 0 and chain.below > 0 then
        fail(("the hole at %s continues on both sides of '%s', the first of 'parts'"):format(at_mm(hole.low), name_of(parts[1])),
          "the first part is the one under the head")
      end
      local up = chain.above == 0
      if #parts == 1 then
        local u = holes.along_axes(given.frame, chain.u)
        local along_first = math.abs(u[3]) > 0.01 and u[3] or math.abs(u[2]) > 0.01 and u[2] or u[1]
        up = (given.head and dot(given.head, chain.u) or along_first) > 0
      end
      local one = { holes = chain.holes, near_by = chain.near_by, head = up and chain.high or chain.low, grip = chain.grip, towards = up and chain.u or { -chain.u[1], -chain.u[2], -chain.u[3] } }
      if #parts > 1 and given.head and dot(unit(given.head), one.towards) < 0.01 then
        fail(("'head' points away from the head of the bolt at %s"):format(at_mm(one.head)),
          ("of several 'parts' the first, '%s', is the one under the head: 'head' is for a single part"):format(name_of(parts[1])))
      end
      if given.where and not given.where(one.head[1], one.head[2], one.head[3]) then
        one, n_elsewhere = nil, n_elsewhere + 1
      elseif #parts > 1 and #chain.holes == 1 then
        left = left or { hole = hole, near_by = chain.near_by }
        one = nil
      end
      chains[#chains + 1] = one
    end
  end
  if #chains == 0 and n_elsewhere > 0 and not left then
    fail(("'where' rejects all %d holes %s"):format(n_elsewhere, which), "it receives the end of each hole at the head, in metres")
  end
  if #chains == 0 then
    local hint = list_of(all, parts)
    if left and left.near_by then
      hint = ("the hole of '%s' at %s and that of '%s' are %s apart along their axis"):format(name_of(parts[1]), at_mm(left.hole.low),
        name_of(parts[left.near_by.hole.part]), in_mm(left.near_by.gap))
    elseif left then
      hint = ("the hole of '%s' at %s continues in no other part; %s"):format(name_of(parts[1]), at_mm(left.hole.low), hint)
    end
    fail(("no hole %s goes through %s"):format(which, #parts > 1 and "these parts" or ("'%s'"):format(name_of(parts[1]))), hint)
  end
  if not given.where then check_all_are_passed(chains, parts, fail) end
  table.sort(chains, function(a, b)
    local of_a, of_b = holes.along_axes(given.frame, a.head), holes.along_axes(given.frame, b.head)
    for i = 1, 3 do
      local p, q = micrometres(of_a[i]), micrometres(of_b[i])
      if p ~= q then return p < q end
    end
    return false
  end)
  if given.n and given.n ~= #chains then
    local places = {}
    for i, one in ipairs(chains) do places[i] = at_mm(one.head) end
    fail(("%d holes %s go through these parts, and n = %d"):format(#chains, which, given.n), "heads at " .. table.concat(places, ", "))
  end
  return chains
end

-- "'bracket', 'pad'", the parts that a chain passes, from the head on.
function holes.parts_of(chain, parts)
  local passed = {}
  for i, hole in ipairs(chain.holes) do passed[i] = ("'%s'"):format(name_of(parts[hole.part])) end
  return table.concat(passed, ", ")
end

return holes
