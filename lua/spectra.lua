-- Spectra along several directions at one place, and what a deck without motion leaves out.
local native = ...
local frames = native.module "frames"
local spectra = {}

local made_for_spectra = setmetatable({}, { __mode = "k" })  -- histories

local function fail(entry, line, text, hint) native.fail(line, entry.path .. ": " .. text .. (hint and "\n    " .. hint or "")) end

-- What is said of one direction, where there may be something for each.
local function of_direction(value, name)
  if type(value) == "table" and value.by_name then return value.by_name[name] end
  return value
end

local function check_names(entry, given, line)
  local names, is_known = {}, {}
  for i, direction in ipairs(given.directions) do names[i], is_known[direction[1]] = direction[1], true end
  for _, key in ipairs { "specification", "margin" } do
    local of_names = type(given[key]) == "table" and given[key].by_name or {}
    for name in pairs(of_names) do
      if not is_known[name] then
        fail(entry, line, ("'%s' has '%s', which is not a direction of the spectra"):format(key, name), native.did_you_mean(name, names))
      end
    end
  end
  for _, name in ipairs(names) do
    if of_direction(given.margin, name) and not of_direction(given.specification, name) then
      fail(entry, line, ("'margin' needs a specification for '%s'"):format(name), "give margins only to directions with a specification")
    end
  end
end

local function at_place(entry, given, line)
  check_names(entry, given, line)
  local list, fields = {}, { histories = {} }
  for _, direction in ipairs(given.directions) do
    local key, along = direction[1], direction[2]
    local name = given.name .. " " .. key
    local history = native.make("output.history", "output",
      { name = name .. " acceleration", on = given.on, quantity = "acceleration", direction = along }, line)
    made_for_spectra[history] = true
    local own = {}
    for argument, value in pairs(given) do own[argument] = value end
    own.name, own.of, own.on, own.directions = name, history, nil, nil
    own.specification, own.margin = of_direction(given.specification, key), of_direction(given.margin, key)
    fields[key] = native.make(entry.path, "output", own, line)
    fields.histories[key] = history
    list[#list + 1], list[#list + 2] = history, fields[key]
  end
  return setmetatable(list, { __metatable = false, __index = function(_, key)
    if type(key) ~= "string" then return nil end
    if fields[key] ~= nil then return fields[key] end
    local known = {}
    for name in pairs(fields) do known[#known + 1] = name end
    native.fail(native.line(), ("the spectra '%s' have no '%s'\n    %s"):format(given.name, key, native.did_you_mean(key, known)))
  end })
end

function spectra.declare(entry, given, line)
  if given.of and given.on then fail(entry, line, "'of' and 'on' are mutually exclusive", "'of' a history, or 'on' a place, where it makes histories of its own") end
  if given.on then
    given.directions = given.directions or frames.axes()
    local list = at_place(entry, given, line)
    return list
  end
  for _, key in ipairs { "specification", "margin" } do
    if type(given[key]) == "table" and given[key].by_name then
      fail(entry, line, ("'%s' by directions needs 'on'"):format(key), "a spectrum 'of' a history has one")
    end
  end
  local spectrum = native.make(entry.path, "output", given, line)
  return spectrum
end

-- Takes from a problem whose steps are all static the outputs `of_motion`, by their paths, and says so.
function spectra.leave_out(given, of_motion, line)
  for _, step in ipairs(given.steps) do
    if select(2, native.kind(step)) == "step.dynamic" then return end
  end
  local kept, left, names = {}, {}, {}
  for _, output in ipairs(given.outputs) do
    local _, path, name = native.kind(output)
    local is_left = of_motion[path]
    if is_left then names[#names + 1] = ("'%s'"):format(name) end
    if is_left or made_for_spectra[output] then left[#left + 1] = output else kept[#kept + 1] = output end
  end
  if #left == 0 then return end
  given.outputs, given.left_out = kept, left  -- which are used so
  local told = table.concat(names, ", ", 1, math.min(#names, 6)) .. (#names > 6 and (" and %d more"):format(#names - 6) or "")
  native.warn(line, ("problem '%s' has no dynamic step: its spectra are omitted and read as nan: %s"):format(given.name, told))
end

return spectra
