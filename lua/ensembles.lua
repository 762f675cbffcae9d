-- Distributions of parameters, and ensembles: one problem many times, with parameters drawn from them.
local native = ...
local ensembles = {}

local made = setmetatable({}, { __mode = "k" })  -- kind, numbers and factor, by the distribution
function ensembles.is_distribution(value) return made[value] ~= nil end

local function fail(line, text, hint) native.fail(line, text .. (hint and "\n    " .. hint or "")) end

local operators = { __metatable = false }

local function distribution(kind, numbers, factor)
  local value = setmetatable({}, operators)
  made[value] = { kind = kind, numbers = numbers, factor = factor or 1 }
  return value
end

local function scaled(value, factor)
  local given = made[value]
  local answer = distribution(given.kind, given.numbers, given.factor * factor)
  return answer
end

local function refuse(what)
  fail(native.line(), ("a distribution cannot be %s"):format(what), "numbers scale it, as in uniform(0.7, 1.3)*30*kN; compute with its values in 'of'")
end

function operators.__mul(a, b)
  if type(a) == "number" and made[b] then return (scaled(b, a)) end
  if type(b) == "number" and made[a] then return (scaled(a, b)) end
  refuse "multiplied by anything but a number"
end
function operators.__div(a, b)
  if type(b) == "number" and made[a] then return (scaled(a, 1 / b)) end
  refuse "divided by anything but a number, or divide one"
end
function operators.__unm(a) return (scaled(a, -1)) end
for event, what in pairs { __add = "added to", __sub = "subtracted", __pow = "raised to a power", __mod = "divided", __idiv = "divided" } do
  operators[event] = function() refuse(what) end
end
function operators.__index(_, key) fail(native.line(), ("a distribution has no '%s'"):format(tostring(key)), "'of' receives its values") end
function operators.__newindex() fail(native.line(), "a distribution does not change once declared") end

-- uniform(a, b) and the rest, from their entries in the schema.
function ensembles.constructor(entry)
  return function(...)
    local line, n = native.line(), select("#", ...)
    local numbers = { ... }
    if n ~= #entry.arguments then fail(line, ("%s takes %d numbers, got %d"):format(entry[1], #entry.arguments, n), "written " .. entry.write) end
    for i, argument in ipairs(entry.arguments) do
      if type(numbers[i]) ~= "number" then
        fail(line, ("%s: '%s' must be a number"):format(entry[1], argument[1]), "written " .. entry.write)
      end
    end
    native.check_distribution(entry[1], numbers, line)
    local value = distribution(entry[1], numbers)
    return value
  end
end

-- The distribution of a parameter as `vary` gives it: one of those, or a list of numbers; nothing where it is neither.
local function distribution_of(value)
  if made[value] then return value end
  if type(value) ~= "table" or native.kind(value) or #value < 2 then return nil end
  for i, number in ipairs(value) do
    if type(number) ~= "number" then return nil end
  end
  local list = distribution("list", table.move(value, 1, #value, 1, {}))
  return list
end

local allowed = "a distribution, a list of numbers, or { distribution, each = list }"

-- Parameters by name: a distribution, and of how many items each draws its own (none: one for all).
function ensembles.check_vary(call_fail, given, label)
  local names, vary = {}, {}
  for key, value in pairs(given) do
    if type(key) ~= "string" or not key:match "^[%a_][%w_]*$" then
      call_fail(("'%s' takes distributions by name, as { mu = uniform(0.1, 0.3) }"):format(label))
    end
    local each = type(value) == "table" and not made[value] and not native.kind(value) and rawget(value, "each")
    local of = distribution_of(each and value[1] or value)
    if not of then call_fail(("'%s.%s' must be %s"):format(label, key, allowed)) end
    if type(each) == "table" and #each == 0 and next(each) == nil then
      call_fail(("'%s.%s.each' is empty: there is nothing to draw for"):format(label, key))
    end
    if each and (type(each) ~= "table" or #each == 0) then
      call_fail(("'%s.%s.each' must be a list, as in each = bolts"):format(label, key))
    end
    names[#names + 1] = key
    vary[key] = { of = of, n = each and #each or nil }
  end
  if #names == 0 then call_fail(("'%s' is empty"):format(label)) end
  table.sort(names)
  vary[1] = names
  return vary
end

-- One column of the design a parameter, or an item of one.
local function columns_of(vary)
  local names, drawn = {}, {}
  for _, key in ipairs(vary[1]) do
    for i = 1, vary[key].n or 1 do
      names[#names + 1] = vary[key].n and ("%s[%d]"):format(key, i) or key
      drawn[#drawn + 1] = made[vary[key].of]
    end
  end
  return names, drawn
end

-- One number for each item of 'each'. What lies beyond must not read as nothing: a law would take its default.
local function drawn_list(name, list, who)
  return setmetatable(list, {
    __metatable = "list",
    __index = function(_, key)
      who.text = nil
      if type(key) ~= "number" then
        fail(native.line(), ("'%s' is a list of %d numbers, and has none called '%s'"):format(name, #list, tostring(key)),
          ("its values are %s[1] to %s[%d], by numbers without quotes"):format(name, name, #list))
      end
      fail(native.line(), ("'%s[%s]': '%s' is drawn for %d items of its 'each'"):format(name, tostring(key), name, #list),
        ("its values are %s[1] to %s[%d]"):format(name, name, #list))
    end,
    __newindex = function(_, key) fail(native.line(), ("'%s[%s]' of a member is drawn, and cannot be assigned"):format(name, tostring(key))) end,
  })
end

-- What `of` is given: the parameters by name. `read` notes which it asks for; a wrong name is no matter of `who` drew.
local function values_of(vary, row, read, who)
  local values, at = {}, 0
  for _, key in ipairs(vary[1]) do
    local list = {}
    for i = 1, vary[key].n or 1 do at = at + 1; list[i] = row[at] end
    values[key] = vary[key].n and drawn_list(key, list, who) or list[1]
  end
  return setmetatable({}, {
    __metatable = false,
    __index = function(_, key)
      read[key] = true
      if values[key] ~= nil then return values[key] end
      who.text = nil
      fail(native.line(), ("the ensemble does not vary '%s'"):format(tostring(key)), native.did_you_mean(tostring(key), vary[1]))
    end,
    __newindex = function(_, key) fail(native.line(), ("'%s' of a member is drawn, and cannot be assigned"):format(tostring(key))) end,
    __pairs = function()
      for _, key in ipairs(vary[1]) do read[key] = true end
      return next, values, nil
    end,
  })
end

local function size_of(given, n_columns, line)
  if given.method ~= "corners" then
    if not given.n then fail(line, "ensemble: 'n' is missing", "the number of members, as in n = 16") end
    if given.method == "sobol" and n_columns > 21 then
      fail(line, ("ensemble: \"sobol\" takes 21 parameters at most, got %d"):format(n_columns), 'method = "latin hypercube" takes any number')
    end
    return given.n
  end
  if n_columns > 10 then fail(line, ("ensemble: \"corners\" takes 10 parameters at most, got %d"):format(n_columns), "10 parameters have 1024 corners") end
  local n = 2 ^ n_columns // 1 | 0
  if given.n and given.n ~= n then fail(line, ("ensemble: %d parameters have %d corners, 'n' = %d"):format(n_columns, n, given.n), "omit 'n'") end
  return n
end

-- "member 3 of 16 draws mu = -0.04": for the message of what a member's problem cannot be. Those below zero come first.
local function told(names, drawn, row, i, n)
  local most, below, others, hint = 6, {}, {}, ""
  for j, name in ipairs(names) do
    local list = row[j] < 0 and below or others
    list[#list + 1] = ("%s = %.6g"):format(name, row[j])
    if row[j] < 0 and drawn[j].kind == "normal" then hint = ": a normal law reaches below zero, which a lognormal one does not" end
  end
  local values = table.move(others, 1, #others, #below + 1, below)
  local more = #values > most and (", and %d more"):format(#values - most) or ""
  return ("member %d of %d draws %s%s%s"):format(i, n, table.concat(values, ", ", 1, math.min(#values, most)), more, hint)
end

local function problems_of(given, rows, names, drawn, line)
  local problems, read = {}, {}
  for i, row in ipairs(rows) do
    local who = { text = told(names, drawn, row, i, #rows) }
    local problem = native.call_member(given.of, values_of(given.vary, row, read, who), who)
    if native.kind(problem) ~= "problem" then
      fail(line, "ensemble: 'of' must return a problem", "as in of = function(v) return problem{ ... } end, which is not run")
    end
    local differs = i > 1 and native.difference_of_members(problems[1], problem)
    if differs then
      fail(line, ("ensemble: members differ in %s"):format(differs),
        "they share all that is built of meshes, materials, places and steps: what changes these is a study")
    end
    problems[i] = problem
  end
  for _, key in ipairs(given.vary[1]) do
    if not read[key] then native.warn(line, ("ensemble: 'of' never uses '%s'"):format(key)) end
  end
  return problems
end

-- Members after the first, side by side from its fields: whether they could.
local function run_rest(tour, members, problems, label, line)
  local own, cases = {}, {}
  for at = 2, #tour do own[at - 1], cases[at - 1] = problems[tour[at]], label:format(tour[at]) end
  local results = native.run_together(own, cases, members[tour[1]], line)
  for at = 2, results and #tour or 0 do members[tour[at]] = results[at - 1] end
  return results ~= nil
end

-- ensemble{ ... }:run{}: the first member, and the others side by side where they share its operators and leave no files;
-- else one after the other, each from its neighbour's fields. Then what they come to.
function ensembles.run(self, asked, line)
  local given = native.arguments(self)
  local names, drawn = columns_of(given.vary)
  local n = size_of(given, #names, line)
  local rows, tour = native.draw(given.method, n, given.seed, drawn)
  local problems = problems_of(given, rows, names, drawn, line)
  native.check_folder(problems[1], asked.case)
  local digits, members, last = ("%d"):format(#("%d"):format(n)), {}, nil
  local label = asked.case .. "_%0" .. digits .. "d"
  for at, i in ipairs(tour) do
    if at == 2 and not asked.members and run_rest(tour, members, problems, label, line) then break end
    local arguments = { case = label:format(i), check_cold = false, start_from = last, member = asked.members and "written" or "quiet" }
    members[i] = native.call("problem:run", problems[i], arguments, line)
    if last then native.let_go(last) end
    last = members[i]
  end
  native.let_go(last)
  local result = native.conclude(self, {
    case = asked.case, method = given.method, seed = given.seed, names = names, rows = rows, members = members, problems = problems,
    keeps_members = asked.members,
  }, line)
  return result
end

return ensembles
