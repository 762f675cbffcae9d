local steel = material.elastic{ name = "steel"
local x = 3
