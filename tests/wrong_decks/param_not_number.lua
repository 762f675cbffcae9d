local p = param{ material = "steel" }
