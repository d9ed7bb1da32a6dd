#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

namespace pendular {

/// The places at which the store keeps grains, by identity. Identities are given once and for all, so those
/// of removed grains leave gaps; they are kept in pages, and a page without grains takes no memory: a run in
/// which millions of grains come and go does not grow.
class PlaceIndex {
public:
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    /// `none` if there is no such grain.
    [[nodiscard]] std::uint32_t operator[](std::uint32_t identity) const {
        const std::size_t page = identity / pageSize;
        if (page >= pages.size() || pages[page].empty()) return none;
        return pages[page][identity % pageSize];
    }
    [[nodiscard]] bool contains(std::uint32_t identity) const { return (*this)[identity] != none; }
    /// How many grains there are.
    [[nodiscard]] std::size_t size() const { return count; }
    [[nodiscard]] bool empty() const { return count == 0; }
    /// The highest identity of all grains; `none` without any.
    [[nodiscard]] std::uint32_t last() const {
        for (std::size_t page = pages.size(); page-- > 0;)
            for (std::size_t within = pages[page].size(); within-- > 0;)
                if (pages[page][within] != none) return static_cast<std::uint32_t>(page * pageSize + within);
        return none;
    }

    void set(std::uint32_t identity, std::uint32_t place);
    void erase(std::uint32_t identity);
    void clear();
    [[nodiscard]] std::size_t bytes() const;

    /// Over the places of all grains, in the order of their identities.
    class Iterator {
    public:
        using value_type = std::uint32_t;
        using difference_type = std::ptrdiff_t;
        using iterator_category = std::forward_iterator_tag;
        using pointer = const std::uint32_t*;
        using reference = std::uint32_t;

        Iterator() = default;
        Iterator(const PlaceIndex& of, std::size_t page) : index(&of), page(page) { skipGaps(); }
        std::uint32_t operator*() const { return index->pages[page][within]; }
        Iterator& operator++() {
            ++within;
            skipGaps();
            return *this;
        }
        Iterator operator++(int) {
            Iterator old = *this;
            ++*this;
            return old;
        }
        friend bool operator==(const Iterator&, const Iterator&) = default;

    private:
        void skipGaps() {
            for (; page < index->pages.size(); ++page, within = 0)
                for (; within < index->pages[page].size(); ++within)
                    if (index->pages[page][within] != none) return;
        }

        const PlaceIndex* index = nullptr;
        std::size_t page = 0, within = 0;
    };
    [[nodiscard]] Iterator begin() const { return {*this, 0}; }
    [[nodiscard]] Iterator end() const { return {*this, pages.size()}; }

    friend bool operator==(const PlaceIndex&, const PlaceIndex&) = default;

private:
    static constexpr std::size_t pageSize = 1024;

    std::vector<std::vector<std::uint32_t>> pages;  // empty ones have no grains
    std::vector<std::uint32_t> used;                // grains of each page
    std::size_t count = 0;
};

}  // namespace pendular
